# How far the distribution of rotational energy is from chi-square:
# Figs. 3 (case 1) and 6 (case 2) of Ogawa & Kato 1982.
#
# needs: series.csv: time, dh_rot
# rank: 6
# measure: hellinger_floor
# groups: restitution
quantity = 'dh_rot'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
is_logarithmic = 1
set logscale y
set format y '10^{%T}'
plot @curves, @error_bars, \
     for [i = 1:(hellinger_floor > 0)] hellinger_floor \
         with lines linewidth 1.5 dashtype 3 linecolor rgb theory_color title 'chance'
