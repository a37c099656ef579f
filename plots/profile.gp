# Surface of the bed above the floor of the box at the end of each stage; equal scales, so that slopes
# are seen as they are.
#
# needs: profile-*.csv: x, height_end
# rank: 9
set xlabel label_of('x') noenhanced
set ylabel upright(label_of('height_end')) noenhanced
set size ratio -1
# As far as there is a bed.
x_low = 1e9
x_high = -1e9
tall = 0
bed(x, y) = (y > 0 && x < x_low ? (x_low = x) : 0, y > 0 && x > x_high ? (x_high = x) : 0, y)
do for [i = 1:|files|] {
  stats files[i] using (bed(column('x'), column('height_end'))) nooutput
  tall = STATS_max > tall ? STATS_max : tall
}
margin = 0.03 * (x_high - x_low) + 1
tall = 1.05 * tall
set xrange [x_low - margin:x_high + margin]
set yrange [0:tall]
# It begins where the axis does, which equal scales may move to the right.
legend_columns = floor((line_length - 18) / (longest_label + 13.0))
set key outside top left horizontal maxcols (legend_columns > 1 ? legend_columns : 1)
if (height_is_free) {
  height = fitted_height(tall, x_high - x_low + 2 * margin)
  @set_terminal
}
if (dots > 0) {
  set xtics few((x_high - x_low) / 2)
}
if (dots > 0 || tall < 0.4 * (x_high - x_low)) {
  set ytics few(tall / 2)
}
plot for [i = 1:|files|] files[i] using (column('x')):(column('height_end')) \
         with lines linewidth 2 linecolor rgb color(i, |files|) title 'end of ' . labels[i]
