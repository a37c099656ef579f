# Neighbours kept against the distance fallen; within, the spread B of the flow against the diameter of the grains.
# usage: gnuplot -c neighbours-kept.gp FOLDER PICTURE.png
load 'bench/rivals/style.gnuplot'
table = ARG1 . '/kept.csv'
set output ARG2
set xlabel 'distance fallen, d'
set ylabel 'share of neighbours kept'
set xrange [0:20]
set yrange [0:1]
set multiplot
plot for [i = 1:5] table using 1:(column(i + 1)) with linespoints linewidth 2 pointtype 7 pointsize 0.6 \
     dashtype 1 + (i == 1) linecolor rgb colors[i] title columnheader(i + 1)
set origin 0.36, 0.60
set size 0.36, 0.38
unset key
set xlabel 'd, spacings'
set ylabel 'B/d'
set xrange [0:9]
set yrange [0:1.2]
set xtics 2
set ytics 0.4
plot for [i = 1:5] ARG1 . '/spread.csv' every ::(i - 1)::(i - 1) using 1:2:3 with yerrorbars linewidth 2 pointtype 7 \
     pointsize 1 linecolor rgb colors[i]
unset multiplot
