# Flux across each line of the scene over a stage, with bands of one standard error.
#
# needs: lines-*.csv: x, y, position, flux
# groups: line
# one figure for each: file
load templates . '/lines.gpi'
set ylabel 'flux to the right of the line, sites/(step·spacing)'
quantity = 'flux'
plot @profile
