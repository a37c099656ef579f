# Height of the intruder by cycle of shaking.
#
# needs: cycles.csv: cycle, intruder_height_rel
# groups: stage
set xlabel 'cycle'
set ylabel 'height of the intruder (0 at the bottom, 1 on top)'
plot for [g = 1:|groups|] 'cycles.csv' using (of_group(g, column('cycle'))):(column('intruder_height_rel')) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]
