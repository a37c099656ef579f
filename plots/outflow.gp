# What has left through outlets; the slope is the outflow.
#
# needs: series.csv: step, discharged_sites
# rank: 8
# groups: stage
quantity = 'discharged_sites'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:*]
plot @stages
