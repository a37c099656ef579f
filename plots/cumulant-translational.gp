# Second cumulant of the translational motion: 0 for a normal distribution.
#
# needs: series.csv: time, a2_tr
# rank: 4
# groups: restitution
quantity = 'a2_tr'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
plot @curves, @error_bars
