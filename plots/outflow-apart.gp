# What has left through each outlet, and of each species.
#
# needs: series.csv: step, discharged.*
# rank: 7
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of('discharged')) noenhanced
set yrange [0:*]
plot @walls
