# Distribution of the translational energy at the times of the histograms, and chi-square with 3 degrees
# of freedom: Fig. 4 (case 2) of Ogawa & Kato 1982.
#
# needs: histogram-*.csv: energy=translational, lower, upper, share
# rank: 5
# groups: restitution
# one figure for each: group
energy = 'translational'
is_meant(x) = strcol('energy') eq energy ? of_group(1, x) : NaN
# The last bin has no end and so no density; the line of the one before ends where it begins.
is_open(x) = strcol('upper') eq ''
width_of_bin(x) = is_open(x) ? NaN : real(strcol('upper')) - column('lower')
previous = 0
density(x) = is_open(x) ? previous : (previous = column('share') / width_of_bin(x))
least = 1e-12  # in place of 0, which a logarithmic axis does not have
chi_square(x) = sqrt(x / (2 * pi)) * exp(-x / 2)
bars = has('histogram-*.csv:share_se') ? |files| : 0
stats files[1] using (column('upper')) nooutput
set xlabel 'X = |v|² / v_0²(t)'
set ylabel 'probability density of X'
set title titled(groups[1] eq '' ? '' : 'ε = ' . groups[1])
is_logarithmic = 1
set logscale y
set format y '10^{%T}'
set xrange [0:STATS_max]
set yrange [1e-4<*:*]
set samples 400
plot for [i = 1:|files|] files[i] using (is_meant(column('lower'))):(density(0) + least) \
         with steps linewidth 2 linecolor rgb color(i, |files|) title 'time ' . labels[i], \
     for [i = 1:bars] files[i] \
         using (is_meant(column('lower') + width_of_bin(0) / 2)): \
               (foot(density(0), column('share_se') / width_of_bin(0))): \
               (0):(rise(density(0), column('share_se') / width_of_bin(0))) \
         @bar_style linecolor rgb color(i, |files|) notitle, \
     chi_square(x) with lines dashtype 2 linewidth 2 linecolor rgb theory_color title 'chi-square'
