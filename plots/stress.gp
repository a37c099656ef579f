# Pressure tensor of a sheared gas, and the theory of its steady state where a table has it.
#
# needs: series.csv: time, p_xx, p_yy, p_xy
# rank: 8
# may use: closure.csv
# groups: restitution
# one figure for each: group
array parts[3] = ['p_xx', 'p_yy', 'p_xy']
array names[3] = ['p_{xx}', 'p_{yy}', 'p_{xy}']
bars = has('series.csv:p_xy_se') ? 3 : 0
theories = has('closure.csv:p_xy') ? 3 : 0
@set_time_axis
set ylabel 'stress / mean pressure'
set key enhanced
plot for [i = 1:3] 'series.csv' using (of_group(1, column('time'))):(column(parts[i])) \
         with lines linewidth 2 linecolor rgb color(i, 3) title names[i], \
     for [i = 1:bars] 'series.csv' every rows_per_bar \
         using (of_group(1, column('time'))):(foot(column(parts[i]), column(parts[i] . '_se'))): \
               (0):(rise(column(parts[i]), column(parts[i] . '_se'))) \
         @bar_style linecolor rgb color(i, 3) notitle, \
     for [i = 1:theories] 'closure.csv' \
         using (of_group(1, column('time'))):(column(parts[i])) \
         with lines linewidth 1.5 dashtype 2 linecolor rgb color(i, 3) notitle, \
     for [i = 1:(theories > 0)] NaN \
         with lines linewidth 1.5 dashtype 2 linecolor rgb theory_color title 'theory, steady'
