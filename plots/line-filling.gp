# Share of each line of the scene that particles cover, of what no wall covers; mean over a stage.
#
# needs: lines-*.csv: x, y, position, filling
# groups: line
# one figure for each: file
load templates . '/lines.gpi'
set ylabel upright(label_of('filling')) noenhanced
set yrange [0:1]
plot for [g = 1:|groups|] files[1] using (of_group(g, column(across))):(column('filling')) \
         with lines linewidth 2 linecolor rgb color(g, |groups|) title groups[g]
