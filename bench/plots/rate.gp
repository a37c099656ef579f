# Particle-updates per second, against the number of particles.
load 'bench/plots/style.gnuplot'
set title 'Particle-updates (particles × steps) per second'
set xlabel 'particles'
set ylabel 'updates per second'
plot for [i = 1:3] for [t = 1:most_threads] table('automaton') \
         using 'particles':(of(moving[i], t, column('effective_per_s'))) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb colors[i] \
         title curve(i, t)
