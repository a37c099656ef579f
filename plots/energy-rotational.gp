# Distribution of the rotational energy at the times of the histograms, and chi-square with 3 degrees
# of freedom: Figs. 2 (case 1) and 5 (case 2) of Ogawa & Kato 1982.
#
# needs: histogram-*.csv: energy=rotational, lower, upper, share
# groups: restitution
# one figure for each: group
energy = 'rotational'
is_meant(x) = strcol('energy') eq energy ? of_group(1, x) : NaN
density(share) = share / (column('upper') - column('lower'))  # nothing in the open last bin
middle(x) = (column('lower') + column('upper')) / 2
chi_square(x) = sqrt(x / (2 * pi)) * exp(-x / 2)
bars = has('histogram-*.csv:share_se') ? |files| : 0
set xlabel 'X = |ω|² / ω_0²(t)'
set ylabel 'probability density of X'
set title scene . (groups[1] eq '' ? '' : ', ε = ' . groups[1])
set xrange [0:*]
set samples 400
plot for [i = 1:|files|] files[i] \
         using (is_meant(middle(0))):(density(column('share'))) \
         with histeps linewidth 2 linecolor rgb color(i, |files|) title 'time ' . labels[i], \
     for [i = 1:bars] files[i] \
         using (is_meant(middle(0))):(density(column('share'))):(density(column('share_se'))) \
         with yerrorbars pointtype 7 pointsize 0.3 linecolor rgb color(i, |files|) notitle, \
     chi_square(x) with lines dashtype 2 linewidth 2 linecolor rgb theory_color title 'chi-square'
