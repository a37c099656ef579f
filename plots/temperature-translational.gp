# Temperature of the translational motion, and its closed form.
#
# needs: series.csv: time, t_tr
# rank: 9
# may use: closure.csv
# groups: restitution
quantity = 't_tr'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
# Cooling gases are read on a logarithmic scale; sheared ones come to a steady state.
if (!has('series.csv:p_xy')) {
  is_logarithmic = 1
  set logscale y
}
plot @curves, @error_bars, @theory
