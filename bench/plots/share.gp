# Time for each particle that moves, against the share of the particles that move, for the largest
# number of particles.
load 'bench/plots/style.gnuplot'
of_most(y) = column('particles') == most_particles ? y : NaN
set title sprintf('%g particles: time for each that moves', most_particles)
set xlabel 'share that moves'
set ylabel 'ns'
set format y '%g'
plot for [i = 1:3] for [t = 1:most_threads] table('shares') \
         using 'moving_share':(of_most(of(moving[i], t, column('ns_per_move')))) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb colors[i] \
         title curve(i, t)
