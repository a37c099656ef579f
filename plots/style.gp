# What all figures share; run before each template. Set before it: width and height in pixels, and
# what docs/plots.md lists. For gnuplot 5.4 and later.
set encoding utf8
scale = (width + 1.6 * height) / 1920.0
if (strstrt(GPVAL_TERMINALS, ' pngcairo ') > 0) {
  set terminal pngcairo size width, height font 'DejaVu Sans,13' fontscale scale \
      linewidth scale background '#ffffff'
} else {
  set terminal png size width, height background '#ffffff'
}
set output

set datafile separator ','
set datafile columnheaders
set datafile missing NaN

set border 3 linecolor '#404040'
set tics out nomirror
set grid linetype 1 linecolor '#dcdcdc' linewidth 1
set autoscale xfix
set key outside right top vertical Left reverse noenhanced samplen 2.5 spacing 1.25 width 1
set title scene noenhanced offset 0, -0.3

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

# Whether a table has a column with something in it.
has(name) = strstrt(known_columns, '|' . name . '|') > 0

# x in rows of a group, nothing in others.
of_group(g, x) = groups[g] eq '' ? x : (strcol(group_column) eq groups[g] ? x : NaN)

# Parts of plot commands, for figures of a `quantity` over time with a curve for each restitution.
restitution_title(g) = groups[g] eq '' ? 'simulation' : 'ε = ' . groups[g]
set_time_axis = "set xlabel 'time,  1 / (π N (2a)² v_0)'"
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
