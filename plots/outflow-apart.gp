# What has left through each outlet, and of each species.
#
# needs: series.csv: step, discharged.*
set xlabel time_title noenhanced
set ylabel 'discharged, particles'
set yrange [0:*]
plot @walls
