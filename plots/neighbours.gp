# Neighbours kept, and diffusion of pairs, against the distance that they have fallen.
#
# needs: mixing-*.csv: fallen_d, kept
# rank: 7
# one figure for each: file
enough(x) = column('pairs') >= 100 ? x : NaN
set title titled(labels[1])
set xlabel label_of('fallen_d') noenhanced
set ylabel upright(label_of('kept')) noenhanced
set y2label upright(label_of('pair_diffusion')) noenhanced
set y2tics
set border 11
set yrange [0:1]
set y2range [0:*]
set key outside center bottom horizontal maxcols 2
plot files[1] using 'fallen_d':(enough(column('kept'))) with linespoints pointtype 7 pointsize 0.6 \
         linewidth 2 linecolor rgb color(1, 2) title 'neighbours kept', \
     files[1] using 'fallen_d':(enough(column('pair_diffusion'))) axes x1y2 with linespoints \
         pointtype 7 pointsize 0.4 linewidth 1 linecolor rgb color(2, 2) title 'diffusion of pairs (right)'
