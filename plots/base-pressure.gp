# Pressure below a bed at rest, over its mean: weight passed on by rules, and that of the contact model.
#
# needs: weight_paths-*.csv: position, pressure_inner
# rank: 8
# one figure for each: file
rules = 'inner outer pair q'
set title titled(labels[1])
set xlabel label_of('position') noenhanced
set ylabel 'base pressure over its mean'
set yrange [0:*]
set key outside center bottom horizontal maxcols 3
