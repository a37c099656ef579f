# How far walls are from where they were at the beginning, along their motion.
#
# needs: series.csv: step, travel.*
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of('travel')) noenhanced
plot @walls
