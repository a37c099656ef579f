# Flow through each probe, downwards.
#
# needs: probes.csv: step, flow
# rank: 6
# groups: probe
quantity = 'flow'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
plot @stages
