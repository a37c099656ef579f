# What the machine can do: copying, and loads that wait for each other, against the working set.
load 'bench/plots/style.gnuplot'
rate(t) = strcol('quantity') eq 'copy' && column('threads') == t ? 1e-9 * column('value') : NaN
latency(x) = strcol('quantity') eq 'dependent_load' ? 1e9 * column('value') : NaN
set title 'Limits of the machine'
set xlabel 'working set, KiB'
set ylabel 'copying, GB/s read and written'
set y2label 'a load that waits for another, ns'
set format y '%g'
set format y2 '%g'
set logscale y2
set border 11
set y2tics
plot for [t = 1:most_threads] table('machine') using (column('working_set_bytes') / 1024):(rate(t)) \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 dashtype t linecolor rgb '#0072b2' \
         title sprintf('copy, %d thread%s', t, t == 1 ? '' : 's'), \
     table('machine') using (column('working_set_bytes') / 1024):(latency(0)) axes x1y2 \
         with linespoints linewidth 2 pointtype 7 pointsize 0.6 linecolor rgb '#d55e00' \
         title 'dependent load (right)'
