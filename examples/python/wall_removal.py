"""The final profile of the flow test of Sakaguchi et al. 2001, mean and standard error over 16 seeds.

usage: wall_removal.py [FIGURE.png]     (a figure needs matplotlib; all lengths in lattice spacings)
"""

import sys

import clca
import numpy

sweep = clca.sweep("wall-removal", seeds=range(1, 17), set={"output": {}, "rules.inertia": 0}, output="renders/profile")
profiles = [run.table("profile-flow") for run in sweep]
x = profiles[0]["x"]
heights = numpy.array([profile["height_end"] for profile in profiles])
mean = heights.mean(0)
error = heights.std(0, ddof=1) / len(heights) ** 0.5

print("      x    height   error")
for place in range(0, len(x), 10):
    if mean[place] > 0:
        print(f"{x[place]:7.1f} {mean[place]:9.2f} {error[place]:7.2f}")
flow = sweep.measures[sweep.measures["stage"] == "flow"]
for name in ("repose_right_deg", "runout_99"):
    (row,) = flow[flow["measure"] == name]
    print(f"{name}: {row['mean']:.1f} +- {row['standard_error']:.1f}")

if len(sys.argv) > 1:
    from matplotlib import pyplot

    pyplot.errorbar(x, mean, error, errorevery=4, capsize=2)
    pyplot.gca().set(xlabel="x", ylabel="height", aspect="equal", xlim=(0, 200), ylim=(0, 120))
    pyplot.savefig(sys.argv[1], dpi=150)
