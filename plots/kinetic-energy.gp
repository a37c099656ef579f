# Kinetic energy of all grains.
#
# needs: series.csv: step, kinetic_energy
# rank: 6
# groups: stage
quantity = 'kinetic_energy'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
