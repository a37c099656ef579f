# Final profiles side by side, a panel for each number of particles.
# usage: gnuplot -c profiles.gp peers-profiles.csv PICTURE.svg
table = ARG1
set datafile separator ','
values(column) = system(sprintf("awk -F, 'NR > 1 && !seen[$%d]++ {printf \"%%s \", $%d}' '%s'", column, column, table))
runs = system(sprintf("awk -F, 'NR > 1 && !seen[$2 FS $3]++ {printf \"%%s \", $2 FS $3}' '%s'", table))
sizes = values(1)
set terminal svg size 900, 60 + 300 * words(sizes) font 'DejaVu Sans,13' background '#ffffff'
set output ARG2

# Okabe & Ito 2008.
array colors[7] = [0x000000, 0x0072b2, 0x56b4e9, 0xd55e00, 0xe69f00, 0x009e73, 0xcc79a7]
set border 3 linecolor '#404040'
set tics out nomirror
set grid linetype 1 linecolor '#dcdcdc'
set key outside right top Left reverse noenhanced samplen 2.5 spacing 1.25
set xlabel 'x / L0'
set ylabel 'height / L0'
set xrange [0:2.6]
set yrange [0:*]
set size ratio -1
of(run) = run[:strstrt(run, ',') - 1]
how(run) = run[strstrt(run, ',') + 1:]
set multiplot layout words(sizes), 1
do for [size in sizes] {
  set title size . ' particles' noenhanced
  plot for [i = 1:words(runs)] table \
       using (strcol(1) eq size && strcol(2) eq of(word(runs, i)) && strcol(3) eq how(word(runs, i)) ? $4 : NaN):5 \
       with lines linewidth (i == 1 ? 3 : 1.5) linecolor rgb colors[1 + (i - 1) % 7] dashtype 1 + (i > 7) title of(word(runs, i)) . ', ' . how(word(runs, i))
}
unset multiplot
