# Time for each particle that moves, against the number of particles, and what the machine needs at
# least for what such a move touches.
load 'bench/plots/style.gnuplot'
stats table('machine') using (strcol('quantity') eq 'dependent_load' ? column('value') : NaN) nooutput
miss = 1e9 * STATS_max
per_move(seconds) = 1e9 * column(seconds) / column('moved')
set title 'Time for each particle that moves'
set xlabel 'particles'
set ylabel 'ns'
set format y '%g'
plot for [i = 1:3] for [t = 1:most_threads] table('automaton') \
         using 'particles':(of(moving[i], t, column('ns_per_move'))) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb colors[i] \
         title curve(i, t), \
     for [i = 1:3] table('limits') \
         using 'particles':(of(moving[i], 1, per_move('copy_s'))) \
         with lines linewidth 1 linecolor rgb colors[i] title moving[i] . ': copying its lines', \
     for [i = 1:3] table('limits') \
         using 'particles':(of(moving[i], 1, per_move('wait_s'))) \
         with lines linewidth 1.5 dashtype 3 linecolor rgb colors[i] \
         title moving[i] . ': waiting for each', \
     miss with lines linewidth 1.5 dashtype 4 linecolor rgb '#404040' title 'one cache miss'
