# Contacts at the end of a stage: lines between the centres of particles, or from them to a wall. The
# stronger, the wider: by normal force, or by the sites that both have.
#
# needs: contacts-*.csv: x, y
# needs: loads-*.csv: x, y
# rank: 5
# one figure for each: file
strength = has('contacts-*.csv:normal_force') ? 'normal_force' : 'sites'
loads = 'loads-' . labels[1] . '.csv'
stats loads using (column('id')) nooutput
last = int(STATS_max)
array xs[last + 1]
array ys[last + 1]
do for [i = 1:last + 1] {
  xs[i] = NaN; ys[i] = NaN
}
stats loads using (xs[column('id') + 1] = column('x'), ys[column('id') + 1] = column('y')) nooutput
# A wall has a name in place of a number; then the line ends at the contact.
is_known(id) = id == id && id >= 0 && id <= last && xs[int(id) + 1] == xs[int(id) + 1]
is_grain(name) = is_known(column(name)) && strcol(name) eq sprintf('%.0f', column(name))
first_x(d) = is_grain('first') ? xs[int(column('first')) + 1] : NaN
first_y(d) = is_grain('first') ? ys[int(column('first')) + 1] : NaN
second_x(d) = is_grain('second') ? xs[int(column('second')) + 1] : column('x')
second_y(d) = is_grain('second') ? ys[int(column('second')) + 1] : column('y')
stats files[1] using (column(strength)) nooutput
strongest = STATS_max
do for [i = 1:10] {
  set style arrow i nohead linewidth 0.5 * i linecolor rgb color(2, 2)
}
width(d) = column(strength) > 0 ? ceil(10.0 * column(strength) / strongest) : NaN
# The shorter way round a periodic box: at its side a line ends, and goes on at the other.
wide = periodic ? box_right - box_left : 0
apart(d) = second_x(0) - first_x(0)
seam(d) = periodic && abs(apart(0)) > 0.5 * wide ? (apart(0) > 0 ? -1 : 1) : 0
dx(d) = apart(0) + seam(0) * wide
dy(d) = second_y(0) - first_y(0)
share(d) = seam(0) == 0 ? 1 : ((seam(0) < 0 ? box_left : box_right) - first_x(0)) / dx(0)
unit = strength eq 'sites' ? 'sites' : 'grain weights'
set title titled(labels[1] . sprintf(' (widest: %.3g ', strongest) . unit . ')')
unset key
set xlabel 'x, lattice spacings'
set ylabel 'y, lattice spacings'
set size ratio -1
set autoscale fix
if (periodic) {
  set xrange [box_left:box_right]
}
plot files[1] using (width(0) > 0 ? first_x(0) : NaN):(first_y(0)): \
                    (share(0) * dx(0)):(share(0) * dy(0)):(width(0)) \
         with vectors arrowstyle variable, \
     files[1] using (width(0) > 0 && seam(0) != 0 ? second_x(0) : NaN):(second_y(0)): \
                    ((share(0) - 1) * dx(0)):((share(0) - 1) * dy(0)):(width(0)) \
         with vectors arrowstyle variable
