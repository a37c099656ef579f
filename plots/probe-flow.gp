# Flow through each probe, downwards.
#
# needs: probes.csv: step, flow
# groups: probe
quantity = 'flow'
set xlabel time_title noenhanced
set ylabel 'flow, sites per step'
plot @stages
