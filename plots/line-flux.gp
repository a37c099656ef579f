# Flux to the right across each line of the scene over a stage, with bands of one standard error.
#
# needs: lines-*.csv: x, y, position, flux
# groups: line
# one figure for each: file
load templates . '/lines.gpi'
quantity = 'flux'
set ylabel upright(label_of(quantity)) noenhanced
plot @profile
