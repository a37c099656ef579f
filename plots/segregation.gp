# Segregation by cycle of shaking: 0 mixed, 1 all large ones above all small ones.
#
# needs: cycles.csv: cycle, segregation_index
# groups: stage
quantity = 'segregation_index'
across = 'cycle'
set xlabel 'cycle'
set ylabel 'segregation index'
plot @stages
