# What all figures share; run before each template. Set before it is what docs/rendering.md lists. For
# gnuplot 5.4 and later.
set encoding utf8
scale = dots == 0 ? (width + 1.6 * height) / 1920.0 : format eq 'pdf' ? 0.8 : dots / 96.0 * 8 / 13
thin = dots > 0 ? 0.7 : 1  # lines on paper
# Height of letters in pixels; on paper 8 points.
letter = dots > 0 ? 8 * dots / 72.0 : format eq 'svg' ? 13 : (format eq 'pdf' ? 10 : 13) * scale * 96 / 72.0
# Again after a change of `height`, which a template may make where `height_is_free`.
if (format eq 'svg') {
  # Scales with the page that shows it. After a click it shows the coordinates under the pointer.
  set_terminal = "set terminal svg size width, height dynamic mouse standalone name name \
      font sprintf('DejaVu Sans,Helvetica,sans-serif,%.2f', letter) fontscale 1 \
      linewidth thin background '#ffffff'"
} else { if (format eq 'pdf') {
  set_terminal = "set terminal pdfcairo size width / 96.0, height / 96.0 font 'DejaVu Sans,10' \
      fontscale scale linewidth scale * thin background '#ffffff'"
} else { if (strstrt(GPVAL_TERMINALS, ' pngcairo ') > 0) {
  set_terminal = "set terminal pngcairo size width, height font 'DejaVu Sans,13' fontscale scale \
      linewidth scale * thin pointscale scale background '#ffffff'"
} else {
  set_terminal = "set terminal png size width, height background '#ffffff'"
}}}
@set_terminal
set output

set datafile separator ','
set datafile columnheaders
set datafile missing NaN

set border 3 linecolor '#404040'
set tics out nomirror
set grid linetype 1 linecolor '#dcdcdc' linewidth 1
set autoscale xfix
set key outside right top vertical Left reverse noenhanced samplen 2.5 spacing 1.25 width 1
if (dots > 0 || format eq 'svg' || longest_label > line_length / 4) {
  # As many side by side as fit.
  key_columns = floor((line_length - 8) / (longest_label + 6.0))
  set key outside top left horizontal samplen 2
  set key maxcols (key_columns > 1 ? key_columns : 1)
}
# A title and what is behind or, where that does not fit, under it; either may be empty.
titled(label) = title eq '' || label eq '' ? title . label : \
    strlen(title) + strlen(label) + 2 > line_length ? title . "\n" . label : title . ', ' . label
set title titled('') noenhanced offset 0, -0.3

# Okabe & Ito 2008: told apart by colour-blind people too. Where there are more curves, they have
# an order and take steps from dark to light.
array palette_colors[7] = [0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x000000]
array step_colors[5] = [0x440154, 0x3b528b, 0x21918c, 0x5ec962, 0xe5c000]
part(color, unit) = (color / unit) % 256
mixed(a, b, t, unit) = unit * int(part(a, unit) + t * (part(b, unit) - part(a, unit)) + 0.5)
between(a, b, t) = mixed(a, b, t, 65536) + mixed(a, b, t, 256) + mixed(a, b, t, 1)
step_at(x) = between(step_colors[int(x) + 1], step_colors[int(x) + 2], x - int(x))
color(i, count) = count <= 7 ? palette_colors[i] : step_at(3.9999 * (i - 1) / (count - 1.0))
theory_color = '#404040'

# The label of an axis for a column: name and unit.
position = 0
noted(i) = (position = i, 0)
label_of(q) = (position = 0, sum [i = 1:|quantity_keys|] (quantity_keys[i] eq q ? noted(i) : 0), \
    position > 0 ? quantity_labels[position] : q)

# The same on an axis that points up: the unit on a line of its own where both are too long.
unit_at(label) = strstrt(label, ' (')
upright(label) = strlen(label) <= 0.8 * line_length * height / width || unit_at(label) == 0 ? label : \
    substr(label, 1, unit_at(label) - 1) . "\n" . substr(label, unit_at(label) + 1, strlen(label))

# Makes the picture as high as it takes to show `tall` over `wide` at equal scales.
fitted_height(tall, wide) = (room = (width - 11 * letter) * tall / wide + (dots > 0 ? 11 : 8) * letter, \
    room < 0.3 * width ? 0.3 * width : room > width ? width : room)

# Distance of tics that leaves few of them, for a short axis.
decade(x) = 10 ** floor(log10(x))
few(x) = decade(x) * (x > 5 * decade(x) ? 5 : x > 2 * decade(x) ? 2 : 1)

# Whether a table has a column with something in it.
has(name) = strstrt(known_columns, '|' . name . '|') > 0

# x in rows of a group, nothing in others.
of_group(g, x) = groups[g] eq '' ? x : (strcol(group_column) eq groups[g] ? x : NaN)

# Part of plot commands: a `quantity` against the column `across`, with a curve for each stage.
across = time_column
stages = "for [g = 1:|groups|] files[1] using (of_group(g, column(across))):(column(quantity)) \
    with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]"
# The same with a curve for each of the `columns` of the template.
walls = "for [i = 1:|columns|] files[1] using (column(time_column)):(column(columns[i])) \
    with lines linewidth 2 linecolor rgb color(i, |columns|) title column_labels[i]"

# Parts of plot commands, for figures of a `quantity` over time with a curve for each restitution.
restitution_title(g) = groups[g] eq '' ? 'simulation' : 'ε = ' . groups[g]
set_time_axis = "set xlabel label_of('time') noenhanced"
curves = "for [g = 1:|groups|] 'series.csv' \
    using (of_group(g, column('time'))):(column(quantity)) \
    with lines linewidth 2 linecolor rgb color(g, |groups|) title restitution_title(g)"

# Their standard errors; not at every row where that would be a smear. Drawn as arrows, since error
# bars of cairo clear a box around each point. A bar that a logarithmic axis cannot show down to its
# end begins at the point.
stats files[1] using 0 nooutput
rows_per_bar = ceil(STATS_records / (30.0 * |groups|))
is_logarithmic = 0
foot(y, error) = is_logarithmic && y <= error ? y : y - error
rise(y, error) = y + error - foot(y, error)
bar_style = "with vectors heads size graph 0.004, 90 linewidth 1"
bar_groups(name) = has('series.csv:' . name . '_se') ? |groups| : 0
error_bars = "for [g = 1:bar_groups(quantity)] 'series.csv' every rows_per_bar \
    using (of_group(g, column('time'))):(foot(column(quantity), column(quantity . '_se'))): \
          (0):(rise(column(quantity), column(quantity . '_se'))) \
    @bar_style linecolor rgb color(g, |groups|) notitle"

# Their closed forms, dashed.
theory_groups(name) = has('closure.csv:' . name) ? |groups| : 0
theory = "for [g = 1:theory_groups(quantity)] 'closure.csv' \
    using (of_group(g, column('time'))):(column(quantity)) \
    with lines linewidth 1.5 dashtype 2 linecolor rgb color(g, |groups|) notitle, \
  for [i = 1:(theory_groups(quantity) > 0)] NaN \
    with lines linewidth 1.5 dashtype 2 linecolor rgb theory_color title 'closed form'"

# Arrows in cells of width `cell`: of mean length 0.7 cells, and none longer than 1.3, so that the
# fast ones do not hide the others. `d`: in units of the mean.
arrow(d) = d < 1.3 / 0.7 ? 0.7 * cell : 1.3 * cell / d
arrow_style = "with vectors filled head size graph 0.012, 20 linewidth 1.5"
