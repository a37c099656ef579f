"""Fig. 3 of Ogawa & Kato 1982: how the rotational energies of a cooling gas leave chi-square.

usage: ogawa_kato_fig3.py [FIGURE.png]     (a figure needs matplotlib)
"""

import sys

import clca
import numpy

# The paper has 10,000 particles.
run = clca.run("boltzmann-epsilon-sweep", set={"boltzmann.particles": 30_000}, output="renders/fig3", overwrite=True)
series = run.series
restitutions = numpy.unique(series["restitution"])
print("Hellinger distance of the rotational energies from chi-square")
print("restitution   " + "   ".join(f"t = {time:2}" for time in (0, 5, 10, 15)))
for restitution in restitutions:
    rows = series[series["restitution"] == restitution]
    cells = [rows["dh_rot"][numpy.isclose(rows["time"], time)][0] for time in (0, 5, 10, 15)]
    print(f"{restitution:11}   " + "   ".join(f"{cell:.4f}" for cell in cells))

if len(sys.argv) > 1:
    from matplotlib import pyplot

    for restitution in restitutions:
        rows = series[series["restitution"] == restitution]
        pyplot.plot(rows["time"], rows["dh_rot"], label=f"{restitution}")
    pyplot.gca().set(xlabel="time", ylabel="distance from chi-square")
    pyplot.legend(title="restitution")
    pyplot.savefig(sys.argv[1], dpi=150)
