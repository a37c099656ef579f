# Mean velocity across and along each line of the scene over a stage, with bands of one standard error.
#
# needs: lines-*.csv: x, y, position, v_across
# rank: 7
# groups: line
# one figure for each: file
load templates . '/lines.gpi'
set ylabel 'Velocity (' . velocity_unit . ')' noenhanced
quantity = 'v_across'
plot @profile, \
     for [g = 1:|groups|] files[1] using (of_group(g, column(across))):(column('v_along')) \
         with lines linewidth 1.5 dashtype 2 linecolor rgb color(g, |groups|) notitle, \
     NaN with lines linewidth 2 linecolor rgb theory_color title 'across, to the right', \
     NaN with lines linewidth 1.5 dashtype 2 linecolor rgb theory_color title 'along'
