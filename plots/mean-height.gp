# Mean height of all particles above the floor of the box.
#
# needs: series.csv: step, mean_height
# rank: 4
# groups: stage
quantity = 'mean_height'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
