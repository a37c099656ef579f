# Distribution of the index of force over the contacts, at the end of a stage or averaged over it.
#
# needs: forces-*.csv: low, high, count, density
# rank: 6
# Of f in units of its mean: the bins have all one width, and the density integrates to 1 in them.
array means[|files|]
do for [i = 1:|files|] {
  stats files[i] using ((column('low') + column('high')) / 2):(column('count')) nooutput
  means[i] = STATS_sumxy / STATS_sum_y
}
set xlabel 'f / mean f'
set ylabel 'probability density of f / mean f'
set logscale y
set format y '10^{%T}'
plot for [i = 1:|files|] files[i] \
         using ((column('low') + column('high')) / 2 / means[i]):(column('density')) \
         with linespoints linewidth 1.5 pointtype 7 pointsize 0.7 linecolor rgb color(i, |files|) \
         title labels[i]
