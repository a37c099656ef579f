# Segregation by cycle of shaking or turning: 0 mixed, 1 all large ones above all small ones.
#
# needs: cycles.csv: cycle, segregation_index
# rank: 8
# groups: stage
quantity = 'segregation_index'
across = 'cycle'
set xlabel label_of('cycle') noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot @stages
