# Alignment of spins and velocities: 0 without a preferred angle.
#
# needs: series.csv: time, alignment
# groups: restitution
quantity = 'alignment'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
plot @curves, @error_bars
