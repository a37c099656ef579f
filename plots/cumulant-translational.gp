# Second cumulant of the translational motion: 0 for a normal distribution.
#
# needs: series.csv: time, a2_tr
# groups: restitution
quantity = 'a2_tr'
@set_time_axis
set ylabel 'cumulant a_2, translational'
plot @curves, @error_bars
