# Slope of the surface by cycle of shaking.
#
# needs: cycles.csv: cycle, repose_angle_deg
# rank: 8
# groups: stage
set xlabel label_of('cycle') noenhanced
set ylabel label_of('repose_angle_deg') noenhanced
plot for [g = 1:|groups|] files[1] using (of_group(g, column('cycle'))):(column('repose_angle_deg')) \
         with points pointtype 7 pointsize 0.5 linecolor rgb color(g, |groups|) title groups[g]
