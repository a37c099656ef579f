# Slope of the surface by cycle of shaking or turning; with a vessel against gravity.
#
# needs: cycles.csv: cycle, repose_angle_deg
# rank: 8
# groups: stage
quantity = has('cycles.csv:repose_gravity_deg') ? 'repose_gravity_deg' : 'repose_angle_deg'
set xlabel label_of('cycle') noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot for [g = 1:|groups|] files[1] using (of_group(g, column('cycle'))):(column(quantity)) \
         with points pointtype 7 pointsize 0.5 linecolor rgb color(g, |groups|) title groups[g]
