# Bars are one standard error over the seeds.
#
# needs: measures.csv: mean
# one figure for each: measure
unset datafile columnheaders  # arrays have none
of_line(g, i, y) = of_lines[i] == g ? y : NaN
log_x = strstrt(log_axes, 'x') > 0
log_y = strstrt(log_axes, 'y') > 0
# Of what such an axis can show.
least(low, mean, log) = !log || low > 0 ? low : mean > 0 ? mean : NaN
array x_ends[|xs|]
array y_ends[|xs|]
do for [i = 1:|xs|] {
  x_ends[i] = least(lefts[i], xs[i], log_x)
  y_ends[i] = least(lows[i], means[i], log_y)
}
stats x_ends using (x_ends[$1]) nooutput prefix 'LEFT'
stats rights using (rights[$1]) nooutput prefix 'RIGHT'
stats y_ends using (y_ends[$1]) nooutput prefix 'LOW'
stats highs using (highs[$1]) nooutput prefix 'HIGH'
if (log_x) {
  axis = 'x'; low_end = LEFT_min; high_end = RIGHT_max
  load templates . '/log_axis.gpi'
}
if (log_y) {
  axis = 'y'; low_end = LOW_min; high_end = HIGH_max
  load templates . '/log_axis.gpi'
} else {
  # From 0, unless that would leave most of the axis without points.
  pad = HIGH_max > LOW_min ? 0.06 * (HIGH_max - LOW_min) : LOW_min != 0 ? 0.1 * abs(LOW_min) : 1
  bottom = LOW_min >= 0 && LOW_min < 0.5 * HIGH_max + 0.5 * pad ? 0 : LOW_min - pad
  set yrange [bottom:HIGH_max + pad]
}
if (has_words) {
  # Words stand side by side. In a label % begins a format, and %% is a sign.
  label(word) = strstrt(word, '%') == 0 ? word : \
      word[1:strstrt(word, '%')] . '%' . label(word[strstrt(word, '%') + 1:*])
  letters = 0
  set xrange [0.5:|words| + 0.5]
  set xtics () noenhanced
  do for [i = 1:|words|] {
    set xtics add (label(words[i]) i)
    letters = letters + strlen(words[i]) + 2
  }
  if (letters > 0.8 * line_length) {
    set xtics rotate by -30
  }
} else { if (!log_x) {
  pad = RIGHT_max > LEFT_min ? 0.05 * (RIGHT_max - LEFT_min) : LEFT_min != 0 ? 0.1 * abs(LEFT_min) : 1
  set xrange [LEFT_min - pad:RIGHT_max + pad]
}}
set xlabel x_label noenhanced
set ylabel upright(y_label) noenhanced
set title titled(part) noenhanced
# Bars lie over pale points, so that they are seen where they are shorter.
pale(c) = between(c, 0xffffff, 0.55)
bar_style = "with vectors heads size graph 0.012, 90 linewidth 1.5"
wide_bars = sum [i = 1:|xs|] (rights[i] > lefts[i] ? 1 : 0)
plot for [g = 1:|lines|] means using (xs[$1]):(of_line(g, $1, means[$1])) \
         with linespoints linewidth 1.5 pointtype 7 pointsize 0.9 linecolor rgb color(g, |lines|) \
         title lines[g], \
     for [g = 1:|lines|] means using (xs[$1]):(of_line(g, $1, means[$1])) \
         with points pointtype 7 pointsize 0.9 linecolor rgb pale(color(g, |lines|)) notitle, \
     for [g = 1:|lines|] means using (xs[$1]):(of_line(g, $1, means[$1])) \
         with points pointtype 6 pointsize 0.9 linewidth 1 linecolor rgb color(g, |lines|) notitle, \
     for [g = 1:|lines|] means \
         using (xs[$1]):(of_line(g, $1, y_ends[$1])):(0):(highs[$1] - y_ends[$1]) \
         @bar_style linecolor rgb color(g, |lines|) notitle, \
     for [g = 1:(wide_bars ? |lines| : 0)] means \
         using (x_ends[$1]):(of_line(g, $1, means[$1])):(rights[$1] - x_ends[$1]):(0) \
         @bar_style linecolor rgb color(g, |lines|) notitle
