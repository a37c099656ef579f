# Share of the sites of each probe that particles cover.
#
# needs: probes.csv: step, filling
# groups: probe
quantity = 'filling'
set xlabel label_of(time_column) noenhanced
set ylabel upright(label_of(quantity)) noenhanced
set yrange [0:1]
plot @stages
