# Share of the particles that move.
#
# needs: series.csv: step, moving_share
# rank: 5
# groups: stage
quantity = 'moving_share'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:1]
plot @stages
