# Mean height of the surface by cycle.
#
# needs: cycles.csv: cycle, height_mean
# groups: stage
quantity = 'height_mean'
across = 'cycle'
set xlabel 'cycle'
set ylabel 'mean height of the surface, lattice spacings'
set yrange [0:*]
plot @stages
