# How near steps are to what copying the lines that they change would need.
load 'bench/plots/style.gnuplot'
set title 'Time to copy the lines that moves change, as a share of the time of a step'
set xlabel 'particles'
set ylabel 'share'
set format y '%g'
plot for [i = 1:3] for [t = 1:most_threads] table('limits') \
         using 'particles':(of(moving[i], t, column('near_copy'))) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb colors[i] \
         title curve(i, t)
