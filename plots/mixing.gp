# Mixing by cycle of shaking, Lacey’s index: 0 separated, 1 as mixed as by chance.
#
# needs: cycles.csv: cycle, lacey_index
# groups: stage
quantity = 'lacey_index'
across = 'cycle'
set xlabel 'cycle'
set ylabel 'index of mixing'
plot @stages
