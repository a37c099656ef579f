# Overlap that began at each wall: its index of force.
#
# needs: series.csv: step, index.*
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of('index')) noenhanced
set yrange [0:*]
plot @walls
