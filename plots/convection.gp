# Mean drift in a cycle of shaking, as arrows: of mean length 0.7 times the width of a cell, so that
# the fast ones at the surface do not make the others vanish.
#
# needs: convection-*.csv: x, y, dx, dy
# one figure for each: file
cell = 0
before = NaN
drift(x) = sqrt(column('dx') ** 2 + column('dy') ** 2)
pitch(x) = x > before && (cell == 0 || x - before < cell) ? x - before : cell
seen(x) = (cell = pitch(x), before = x)
stats files[1] using (drift(0)):(seen(column('x'))) nooutput
longest = STATS_max_x
k = 0.7 * cell / STATS_mean_x
set title scene . ', ' . labels[1] . sprintf(' (longest: %.2g spacings per cycle)', longest)
unset key
set xlabel 'x, lattice spacings'
set ylabel 'y, lattice spacings'
set size ratio -1
set autoscale fix
set offsets cell, cell, cell, cell
plot files[1] using (column('x') - k / 2 * column('dx')):(column('y') - k / 2 * column('dy')): \
         (k * column('dx')):(k * column('dy')) \
         with vectors filled head size graph 0.012, 20 linewidth 1.5 linecolor rgb color(1, 1)
