# Energy X of the fluctuations over its mean, and chi-square with 2 degrees of freedom.
#
# needs: fluctuation-*.csv: lower, upper, share, reference
# one figure for each: file
array shown[3] = ['share', 'share_local', 'reference']
array names[3] = ['over the mean of the window', 'over the mean of the cell', 'chi-square']
# The last bin has no end and so no density; the line of the one before ends where it begins.
is_open(x) = strcol('upper') eq ''
previous = 0
density(i) = is_open(i) ? previous : \
    (previous = column(shown[i]) / (real(strcol('upper')) - column('lower')))
set title titled(labels[1])
set xlabel 'X'
set ylabel 'probability density of X'
set logscale y
set format y '10^{%T}'
plot for [i = 1:3] files[1] using (column('lower')):(density(i) > 0 ? density(i) : NaN) \
         with steps linewidth 2 dashtype 1 + (i == 3) \
         linecolor rgb (i < 3 ? color(i, 2) : 0x404040) title names[i]
