# What has left through outlets; the slope is the outflow.
#
# needs: series.csv: step, discharged_sites
# groups: stage
quantity = 'discharged_sites'
set xlabel time_title noenhanced
set ylabel 'discharged, sites'
set yrange [0:*]
plot @stages
