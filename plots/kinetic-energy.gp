# Kinetic energy of all grains.
#
# needs: series.csv: step, kinetic_energy
# groups: stage
quantity = 'kinetic_energy'
set xlabel time_title noenhanced
set ylabel 'energy, site weights × spacings'
set yrange [0:*]
plot @stages
