# Flow through each probe, downwards.
#
# needs: probes.csv: step, flow
# rank: 6
# groups: probe
quantity = 'flow'
set xlabel time_title noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot @stages
