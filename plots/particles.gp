# Particles in the box, where some enter or leave.
#
# needs: series.csv: step, changing particles
# groups: stage
quantity = 'particles'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
