# Mean height of the surface above the floor of the box, by cycle.
#
# needs: cycles.csv: cycle, height_mean
# groups: stage
quantity = 'height_mean'
across = 'cycle'
set xlabel label_of('cycle') noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
