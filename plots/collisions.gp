# Collisions in which a particle has taken part.
#
# needs: series.csv: time, collisions
# groups: restitution
quantity = 'collisions'
@set_time_axis
set ylabel upright(label_of(quantity)) noenhanced
plot @curves, @error_bars
