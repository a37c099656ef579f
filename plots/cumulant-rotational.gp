# Second cumulant of the rotational motion: 0 for a normal distribution.
#
# needs: series.csv: time, a2_rot
# rank: 4
# groups: restitution
quantity = 'a2_rot'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
plot @curves, @error_bars
