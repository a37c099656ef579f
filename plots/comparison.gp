# Energies of the particles of an automaton run beside those of a Boltzmann run: shares of bins that
# chi-square makes equally probable, over their share under chi-square.
#
# needs: comparison.csv: quantile_lower, quantile_upper, automaton, automaton_local, boltzmann_translational, reference
# measure: hellinger_automaton
# measure: hellinger_automaton_local
# measure: hellinger_boltzmann_translational
# measure: hellinger_boltzmann_rotational
array names[4] = ['automaton', 'automaton_local', 'boltzmann_translational', 'boltzmann_rotational']
array titles[4] = ['automaton, a temperature for all', 'automaton, one for each cell', \
                   'Boltzmann, translation', 'Boltzmann, rotation']
array distances[4] = [hellinger_automaton, hellinger_automaton_local, \
                      hellinger_boltzmann_translational, hellinger_boltzmann_rotational]
# Spheres that do not spin have no column of their own.
count = has('comparison.csv:boltzmann_rotational') ? 4 : 3
set xlabel 'quantile of chi-square: 2 degrees of freedom in the plane, 3 in space'
set ylabel 'share / share under chi-square'
set xrange [0:1]
set yrange [0:*]
set key outside bottom center horizontal maxcols 1
set bmargin 10.5
plot for [i = 1:count] 'comparison.csv' \
         using ((column('quantile_lower') + column('quantile_upper')) / 2): \
               (column(names[i]) / column('reference')) \
         with histeps linewidth 2 linecolor rgb color(i, count) \
         title sprintf('%s: D_H = %.1e', titles[i], distances[i]), \
     1 with lines dashtype 2 linewidth 2 linecolor rgb theory_color title 'chi-square'
