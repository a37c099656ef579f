# Mean drift in a cycle of shaking or turning, as arrows: of mean length 0.7 times the width of a cell, and none
# longer than 1.3 times it, so that the fast ones at the surface do not hide the others.
#
# needs: convection-*.csv: x, y, dx, dy
# rank: 7
# one figure for each: file
cell = 0
before = NaN
drift(x) = sqrt(column('dx') ** 2 + column('dy') ** 2)
pitch(x) = x > before && (cell == 0 || x - before < cell) ? x - before : cell
seen(x) = (cell = pitch(x), before = x)
stats files[1] using (drift(0)):(seen(column('x'))) nooutput
longest = STATS_max_x
mean = STATS_mean_x
dx(x) = arrow(drift(0) / mean) / mean * column('dx')
dy(x) = arrow(drift(0) / mean) / mean * column('dy')
set title titled(labels[1] . sprintf(' (longest: %.2g spacings per cycle)', longest))
unset key
set xlabel 'x, lattice spacings'
set ylabel 'y, lattice spacings'
set size ratio -1
set autoscale fix
set offsets cell, cell, cell, cell
stats files[1] using (column('x')) nooutput
if (STATS_max < 150) {
  set xtics 20
}
plot files[1] using (column('x') - dx(0) / 2):(column('y') - dy(0) / 2):(dx(0)):(dy(0)) \
         @arrow_style linecolor rgb color(1, 1)
