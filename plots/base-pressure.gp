# Pressure below a bed at rest, over its mean: of weight passed on by rules, and of the contact model.
#
# needs: weight_paths-*.csv: base_position, pressure_inner
# rank: 6
# one figure for each: file
rules = 'inner outer pair q' . (has('weight_paths-*.csv:pressure_contact') ? ' contact' : '')
set title titled(labels[1])
set xlabel label_of('base_position') noenhanced
set ylabel 'base pressure over its mean'
set xrange [-1:1]
set yrange [0:*]
set key outside center bottom horizontal maxcols 5
plot for [i = 1:words(rules)] files[1] using (column('base_position')):(column('pressure_' . word(rules, i))) \
         with linespoints pointtype 7 pointsize 0.6 linewidth (word(rules, i) eq 'contact' ? 3 : 1.5) \
         linecolor rgb color(i, words(rules)) title word(rules, i)
