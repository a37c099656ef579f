"""How slope and run-out of a collapse depend on inertia, over 8 seeds each.

usage: parameter_study.py [FIGURE.png]     (a figure needs matplotlib)
"""

import sys

import clca

NAMES = ("repose_right_deg", "runout_99")

sweep = clca.sweep(
    "wall-removal",
    seeds=range(1, 9),
    vary={"rules.inertia": [0, 0.3, 0.6, 0.9, 0.98]},
    set={"output": {}},
    output="renders/inertia",
)
flow = sweep.measures[sweep.measures["stage"] == "flow"]
rows = {name: flow[flow["measure"] == name] for name in NAMES}
units = {name: sweep[0].measures["flow"][name].unit for name in NAMES}
print("inertia   " + "   ".join(f"{name}, {units[name]}" for name in NAMES))
for slope, runout in zip(*rows.values()):
    print(f"{slope['rules.inertia']:7.2f}   {slope['mean']:.1f} +- {slope['standard_error']:.1f}"
          f"   {runout['mean']:.1f} +- {runout['standard_error']:.1f}")

if len(sys.argv) > 1:
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(9, 4))
    for plot, name in zip(axes, NAMES):
        plot.errorbar(rows[name]["rules.inertia"], rows[name]["mean"], rows[name]["standard_error"], fmt="o-")
        plot.set(xlabel="inertia", ylabel=f"{name}, {units[name]}")
    figure.savefig(sys.argv[1], dpi=150)
