# Mixing by cycle of shaking or turning, Lacey’s index: 0 separated, 1 as mixed as by chance.
#
# needs: cycles.csv: cycle, lacey_index
# rank: 8
# groups: stage
quantity = 'lacey_index'
across = 'cycle'
set xlabel label_of('cycle') noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot @stages
