# Packing and mean velocity in the cells of a grid, over a stage.
#
# needs: fields.csv: x, y, packing
# rank: 7
# groups: stage
# one figure for each: group
load templates . '/cells.gpi'
speed(x) = sqrt(column('vx') ** 2 + column('vy') ** 2)
stats $cells using (speed(0)) nooutput
mean = STATS_records > 0 && STATS_mean > 0 ? STATS_mean : 1
cell = cell_width
dx(x) = arrow(speed(0) / mean) / mean * column('vx')
dy(x) = arrow(speed(0) / mean) / mean * column('vy')
set palette defined (0 '#ffffff', 1 '#0072b2')
set cbrange [0:*]
set title title_of_stage . "\npacking; mean arrow: " . sprintf('%.2g ', STATS_records > 0 ? STATS_mean : 0) . velocity_unit
plot $cells using (column('x')):(column('y')):(cell_width / 2):(cell_height / 2):(column('packing')) \
         with boxxyerror fillstyle solid noborder fillcolor palette, \
     $cells using (column('x') - dx(0) / 2):(column('y') - dy(0) / 2):(dx(0)):(dy(0)) @arrow_style linecolor rgb '#202020'
