# What all figures share. Set before it: folder, with the tables. For gnuplot 5.4 and later.
set encoding utf8
set terminal svg size 960, 600 font 'DejaVu Sans,14' background '#ffffff' dynamic
set datafile separator ','
set datafile columnheaders
set datafile missing NaN

set border 3 linecolor '#404040'
set tics out nomirror
set grid linetype 1 linecolor '#dcdcdc' linewidth 1
set key outside right top vertical Left reverse noenhanced samplen 3 spacing 1.25
set logscale xy
set format xy '10^{%T}'

table(name) = folder . '/' . name . '.csv'
stats table('automaton') using 'threads' nooutput
most_threads = int(STATS_max)
stats table('automaton') using 'particles' nooutput
most_particles = STATS_max

# Okabe & Ito 2008, by case; one dash type for each number of threads.
array moving[3] = ['falling', 'settling', 'collapse']
array colors[3] = [0x0072b2, 0xd55e00, 0x009e73]
curve(i, t) = sprintf('%s, %d thread%s', moving[i], t, t == 1 ? '' : 's')

# y in rows of default ties and sleeping of a case with so many threads, nothing in others.
of(name, t, y) = strcol('case') eq name && column('threads') == t && strcol('ties') eq 'particle' \
                 && column('sleeping') == 1 ? y : NaN
