# Surface of the bed at the end of each stage; equal scales, so that slopes are seen as they are.
#
# needs: profile-*.csv: x, height_end
set xlabel 'x, lattice spacings'
set ylabel 'height, lattice spacings'
set size ratio -1
set yrange [0:*]
plot for [i = 1:|files|] files[i] using (column('x')):(column('height_end')) \
         with lines linewidth 2 linecolor rgb color(i, |files|) title 'end of ' . labels[i]
