# Height of the intruder by cycle of shaking or turning.
#
# needs: cycles.csv: cycle, intruder_height_rel
# rank: 8
# groups: stage
quantity = 'intruder_height_rel'
across = 'cycle'
set xlabel label_of('cycle') noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot @stages
