# Means over the seeds; the band is one standard error to either side.
#
# one figure for each: mean
# rank: 0.5
of_stage = x_column eq 'step' || x_column eq 'time' ? ', since the stage began' : ''
set xlabel x_label . of_stage noenhanced
set ylabel upright(y_label) noenhanced
set title titled(part) noenhanced
if (strlen(log_axes) > 0) {
  set logscale @log_axes
}
# Of a position, as far as there is something; from 0, unless that would leave most of the axis empty.
if ((x_column eq 'x' || x_column eq 'position') && x_high > x_low) {
  set xrange [x_low:x_high]
}
if (strstrt(log_axes, 'y') == 0) {
  pad = y_high > y_low ? 0.05 * (y_high - y_low) : y_low != 0 ? 0.1 * abs(y_low) : 1
  bottom = y_low >= 0 && y_low < 0.5 * y_high + 0.5 * pad ? 0 : y_low - pad
  set yrange [bottom:y_high + pad]
}
plot for [i = 1:|lines|] files[1] every ::firsts[i]::lasts[i] using (column(x_column)): \
         (column(y_column) - column(y_column . '_se')):(column(y_column) + column(y_column . '_se')) \
         with filledcurves fillstyle transparent solid 0.25 noborder linecolor rgb color(i, |lines|) notitle, \
     for [i = 1:|lines|] files[1] every ::firsts[i]::lasts[i] using (column(x_column)):(column(y_column)) \
         with linespoints pointtype 7 pointsize (lasts[i] - firsts[i] < 30 ? 0.5 : 0) \
         linewidth 2 linecolor rgb color(i, |lines|) title lines[i]
