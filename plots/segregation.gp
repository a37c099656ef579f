# Segregation by cycle of shaking: 0 mixed, 1 all large ones above all small ones.
#
# needs: cycles.csv: cycle, segregation_index
# groups: stage
set xlabel 'cycle'
set ylabel 'segregation index'
plot for [g = 1:|groups|] 'cycles.csv' using (of_group(g, column('cycle'))):(column('segregation_index')) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]
