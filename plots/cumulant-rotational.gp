# Second cumulant of the rotational motion: 0 for a normal distribution.
#
# needs: series.csv: time, a2_rot
# groups: restitution
quantity = 'a2_rot'
@set_time_axis
set ylabel 'cumulant a_2, rotational'
plot @curves, @error_bars
