# Share of the particles that move.
#
# needs: series.csv: step, moving_share
# groups: stage
quantity = 'moving_share'
set xlabel time_title noenhanced
set ylabel 'share that moves'
set yrange [0:1]
plot @stages
