# Share of the particles that move, and mean height of all, by stage.
#
# needs: series.csv: step, moving_share, mean_height
# groups: stage
array shown[2] = ['moving_share', 'mean_height']
array names[2] = ['share that moves', 'mean height, spacings']
set lmargin 10
set rmargin at screen 0.78
set multiplot layout 2, 1
do for [i = 1:2] {
  set ylabel names[i]
  if (i == 1) {
    set yrange [0:1]
    set ytics 0.25
  } else {
    set yrange [0:*]
    set ytics autofreq
  }
  set xlabel (i == 2 ? time_title : '') noenhanced
  plot for [g = 1:|groups|] 'series.csv' using (of_group(g, column(time_column))):(column(shown[i])) \
           with lines linewidth 1.5 linecolor rgb color(g, |groups|) \
           title (i == 1 ? groups[g] : '')
  unset title
}
unset multiplot
