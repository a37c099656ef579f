# Flux of voids at two heights above the orifice, beside Litwiniszyn's recursion.
# usage: gnuplot -c voids-flux.gp FOLDER PICTURE.png
load 'bench/rivals/style.gnuplot'
set output ARG2
set xlabel 'distance from the middle of the orifice, d'
set ylabel 'share of the flux, per d'
set xrange [-20:20]
set yrange [0:*]
heights = '5 20'
table(what, height) = ARG1 . '/' . what . '-' . height . '.csv'
plot for [i = 1:2] table('voids', word(heights, i)) using 'x':'share' with points pointtype 7 pointsize 0.8 \
     linecolor rgb colors[i + 1] title 'voids, ' . word(heights, i) . ' d', \
     for [i = 1:2] table('recursion', word(heights, i)) using 'x':'share' with lines linewidth 2 dashtype 2 \
     linecolor rgb colors[i + 1] title 'recursion, ' . word(heights, i) . ' d'
