# The columns of a table that were asked for.
#
# one figure for each: column
set xlabel label_of(x_column) noenhanced
set ylabel upright(label_of(y_column)) noenhanced
if (strlen(log_axes) > 0) {
  set logscale @log_axes
}
has_errors = has(files[1] . ':' . y_column . '_se')
plot for [g = 1:(has_errors ? |groups| : 0)] files[1] using (of_group(g, column(x_column))): \
         (column(y_column) - column(y_column . '_se')):(column(y_column) + column(y_column . '_se')) \
         with filledcurves fillstyle transparent solid 0.25 noborder linecolor rgb color(g, |groups|) notitle, \
     for [g = 1:|groups|] files[1] using (of_group(g, column(x_column))):(column(y_column)) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]
