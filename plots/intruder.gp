# Height of the intruder by cycle of shaking.
#
# needs: cycles.csv: cycle, intruder_height_rel
# groups: stage
quantity = 'intruder_height_rel'
across = 'cycle'
set xlabel 'cycle'
set ylabel 'height of the intruder (0 at the bottom, 1 on top)'
plot @stages
