# Particles in the box, where some enter or leave.
#
# needs: series.csv: step, changing particles
# groups: stage
quantity = 'particles'
set xlabel time_title noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
