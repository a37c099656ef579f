# How far the distribution of translational energy is from chi-square.
#
# needs: series.csv: time, dh_tr
# rank: 6
# measure: hellinger_floor
# groups: restitution
quantity = 'dh_tr'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
is_logarithmic = 1
set logscale y
set format y '10^{%T}'
plot @curves, @error_bars, \
     for [i = 1:(hellinger_floor > 0)] hellinger_floor \
         with lines linewidth 1.5 dashtype 3 linecolor rgb theory_color title 'chance'
