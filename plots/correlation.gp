# Correlation of translational and rotational energy.
#
# needs: series.csv: time, correlation
# groups: restitution
quantity = 'correlation'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
plot @curves, @error_bars
