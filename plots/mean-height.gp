# Mean height of all particles.
#
# needs: series.csv: step, mean_height
# groups: stage
quantity = 'mean_height'
set xlabel time_title noenhanced
set ylabel 'mean height, lattice spacings'
set yrange [0:*]
plot @stages
