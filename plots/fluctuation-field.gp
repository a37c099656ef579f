# Energy of the fluctuations in the cells of a grid, ½⟨|v - ⟨v⟩|²⟩, over a stage.
#
# needs: fields.csv: x, y, fluctuation
# groups: stage
# one figure for each: group
load templates . '/cells.gpi'
set palette defined (0 '#ffffff', 1 '#0072b2')
set cbrange [0:*]
set title title_of_stage . "\n" . label_of('fluctuation') noenhanced
plot $cells using (column('x')):(column('y')):(cell_width / 2):(cell_height / 2):(column('energy')) \
         with boxxyerror fillstyle solid noborder fillcolor palette
