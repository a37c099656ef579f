"""A gate that opens when the bed behind it is level: taps of the floor, and a loop around the steps.

usage: open_when_level.py [PICTURE.png]
"""

import sys

import clca

SCENE = {
    "clca": 1,
    "title": "Opened when level",
    "seed": 1,
    "box": {"width": 150, "height": 90},
    "species": {"grain": {"shape": {"hexagon": 1}}},
    "rules": {"scatter": 1},
    "walls": {
        "floor": {"box": [0, 0, 59, 1], "motion": {"shake": {"amplitude": 2}}},
        "gate": {"box": [60, 0, 61, 90]},
    },
    "stages": [
        {"name": "packing", "fill": {"region": [0, 1, 30, 90], "counts": {"grain": 200}}},
        {"name": "tapping", "move": ["floor"], "until": {"cycles": 1000}},
        {"name": "flow", "remove": ["gate"]},
    ],
}


def unevenness(simulation):
    """Standard deviation of the free surface behind the gate, in lattice spacings."""
    profile = simulation.measure("profile")
    return profile["height"][profile["x"] < 59].std()


simulation = clca.Simulation(SCENE)
while simulation.stage == "packing" and not simulation.ended:
    simulation.step()
print(f"step {simulation.steps}: at rest, the surface is even to {unevenness(simulation):.1f} spacings")
simulation.next_stage()
while unevenness(simulation) > 3 and simulation.step(10):
    pass
print(f"step {simulation.steps}: even to {unevenness(simulation):.1f} spacings, the gate opens")
simulation.next_stage()
while simulation.step(1000):
    pass
print(f"step {simulation.steps}: {simulation.ended}, run-out {simulation.measures['runout_99']!r}")
if len(sys.argv) > 1:
    simulation.picture(color_by="displacement").save(sys.argv[1])
