# Contacts at the end of a stage: lines between the centres of particles, or from them to a wall. The
# stronger, the wider: by normal force, or by the sites that both have.
#
# needs: contacts-*.csv: x, y
# needs: loads-*.csv: x, y
# may use: profile-*.csv
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
end_x(id) = is_known(id) ? xs[int(id) + 1] : column('x')
end_y(id) = is_known(id) ? ys[int(id) + 1] : column('y')
from_x(d) = is_known(column('first')) ? end_x(column('first')) : NaN
dx(d) = end_x(column('second')) - from_x(0)
dy(d) = end_y(column('second')) - end_y(column('first'))
stats files[1] using (column(strength)) nooutput
strongest = STATS_max
do for [i = 1:10] {
  set style arrow i nohead linewidth 0.5 * i linecolor rgb color(2, 2)
}
# Lines around a periodic box are left out: those over more than half of its width.
wide = 1e9
if (has('profile-*.csv:x')) {
  stats 'profile-' . labels[1] . '.csv' using (column('x')) nooutput
  wide = STATS_max
}
width(d) = column(strength) > 0 && abs(dx(0)) < 0.5 * wide \
    ? ceil(10.0 * column(strength) / strongest) : NaN
unit = strength eq 'sites' ? 'sites' : 'grain weights'
set title titled(labels[1] . sprintf(' (widest: %.3g ', strongest) . unit . ')')
unset key
set xlabel 'x, lattice spacings'
set ylabel 'y, lattice spacings'
set size ratio -1
set autoscale fix
plot files[1] using (width(0) > 0 ? from_x(0) : NaN):(end_y(column('first'))): \
                    (dx(0)):(dy(0)):(width(0)) \
         with vectors arrowstyle variable
