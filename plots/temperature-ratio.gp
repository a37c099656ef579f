# Rotational temperature over the translational one, each relative to its beginning, and the closed
# form of it.
#
# needs: series.csv: time, t_tr, t_rot
# rank: 7
# may use: closure.csv
# groups: restitution
ratio(x) = column('t_rot') / column('t_tr')
@set_time_axis
set ylabel 'T_{rot} / T_{tr},  relative to time 0'
stats files[1] using (ratio(0)) nooutput
axis = 'y'; low_end = STATS_min; high_end = STATS_max
load templates . '/log_axis.gpi'
theories = has('closure.csv:t_rot') ? |groups| : 0
plot for [g = 1:|groups|] 'series.csv' using (of_group(g, column('time'))):(ratio(0)) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title restitution_title(g), \
     for [g = 1:theories] 'closure.csv' using (of_group(g, column('time'))):(ratio(0)) \
         with lines linewidth 1.5 dashtype 2 linecolor rgb color(g, |groups|) notitle, \
     for [i = 1:(theories > 0)] NaN \
         with lines linewidth 1.5 dashtype 2 linecolor rgb theory_color title 'closed form'
