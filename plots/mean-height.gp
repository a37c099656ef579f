# Mean height of all particles above the floor of the box.
#
# needs: series.csv: step, mean_height
# rank: 4
# groups: stage
quantity = 'mean_height'
set xlabel time_title noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
