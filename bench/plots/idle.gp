# Time of a step in which nothing can move, against the number of particles.
load 'bench/plots/style.gnuplot'
set title 'A step in which nothing can move'
set xlabel 'particles'
set ylabel 'ns'
set format y '%g'
plot for [t = 1:most_threads] table('automaton') \
         using 'particles':(of('idle', t, 1e9 * column('step_s_best'))) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb '#0072b2' \
         title sprintf('%d thread%s', t, t == 1 ? '' : 's')
