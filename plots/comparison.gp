# Energies of the particles of an automaton run beside those of a Boltzmann run: shares of bins that
# chi-square makes equally probable, over their share under chi-square.
# Needs: folder (with comparison.csv and distances.csv), out (the PNG to write).
set terminal pngcairo size 1200,750 font 'sans,13'
set output out
set datafile separator ','

comparison = folder.'/comparison.csv'
distances = folder.'/distances.csv'

names = 'automaton automaton_local boltzmann_translational boltzmann_rotational'
texts = "'automaton, one temperature per window' 'automaton, one per cell' 'Boltzmann, translation' 'Boltzmann, rotation'"
colours = '#c1440e #e69f00 #0072b2 #56b4e9'

# Spheres that do not spin have no column of their own.
header = system('head -n 1 "'.comparison.'"')
has(name) = strstrt(','.header.',', ','.name.',') > 0

# Hellinger distance of each from chi-square, for the legend.
array distance[words(names)]
do for [i=1:words(names)] {
  distance[i] = NaN
  stats distances using (strcol(1) eq word(names, i) ? (distance[i] = $2) : 0) every ::1 nooutput
}

set title 'Fluctuation energies beside chi-square'
set xlabel 'quantile of chi-square (2 degrees of freedom in the plane, 3 in space)'
set ylabel 'share / share under chi-square'
set xrange [0:1]
set yrange [0:*]
set key top center
set grid lc rgb '#dddddd'

plot 1 with lines lw 2 dt 2 lc rgb '#444444' title 'chi-square', \
     for [i=1:words(names)] (has(word(names, i)) ? comparison : '/dev/null') \
       using ((column('quantile_lower') + column('quantile_upper')) / 2):(column(word(names, i)) / column('reference')) \
       with histeps lw 2 lc rgb word(colours, i) \
       title (has(word(names, i)) ? sprintf('%s: D_H = %.1e', word(texts, i), distance[i]) : '')
