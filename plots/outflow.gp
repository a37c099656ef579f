# What has left through outlets; the slope is the outflow.
#
# needs: series.csv: step, discharged_sites
# groups: stage
set xlabel time_title noenhanced
set ylabel 'discharged, sites'
set yrange [0:*]
plot for [g = 1:|groups|] 'series.csv' \
         using (of_group(g, column(time_column))):(column('discharged_sites')) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]
