# A measure of a sweep against the first varied key, with the intervals of one standard error; a line for each combination
# of the other keys.
#
# needs: measures.csv: mean
# one figure for each: measure
unset datafile columnheaders  # arrays have none
of_line(g, i, y) = of_lines[i] == g ? y : NaN
if (has_words) {
  # Words stand side by side. In a label % begins a format, and %% is a sign.
  label(word) = strstrt(word, '%') == 0 ? word : \
      word[1:strstrt(word, '%')] . '%' . label(word[strstrt(word, '%') + 1:*])
  set xrange [0.5:|words| + 0.5]
  set xtics () noenhanced
  do for [i = 1:|words|] {
    set xtics add (label(words[i]) i)
  }
} else {
  set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
}
if (measure[1:21] eq 'discharged_until_clog') {
  set logscale y
}
set xlabel varied noenhanced
set ylabel measure_label noenhanced
set title titled(stage) noenhanced
plot for [g = 1:|lines|] means using (xs[$1]):(of_line(g, $1, means[$1])) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.8 linecolor rgb color(g, |lines|) \
         title lines[g], \
     for [g = 1:|lines|] means \
         using (xs[$1]):(of_line(g, $1, lows[$1])):(0):(highs[$1] - lows[$1]) \
         @bar_style linecolor rgb color(g, |lines|) notitle
