"""Granular flow by cellular automata, contact dynamics and the Boltzmann equation.

    run = clca.run("wall-removal", seed=3, set={"rules.inertia": 0.5})
    run.measures["flow"]["repose_angle_deg"]
    run.frames[-1].positions

`clca.open` reads a run folder, `clca.sweep` runs a scene for many seeds and values, `clca.Simulation` takes its steps one
by one, `clca.Gas` is a gas of spheres, `clca.Scene` a scene from a dictionary. `clca explain` on the command line lists
all keys of a scene, `clca explain --format quantities` what it can measure.
"""

from ._clca import version
from ._error import Error
from ._frames import Frame, Frames, Kind
from ._gas import Gas
from ._picture import Picture
from ._run import Run, Stage, open, resume, run
from ._scene import Scene
from ._simulation import Simulation
from ._sweep import Sweep, sweep
from ._table import Table, Value

__version__ = version()
__all__ = [
    "Error",
    "Frame",
    "Frames",
    "Gas",
    "Kind",
    "Picture",
    "Run",
    "Scene",
    "Simulation",
    "Stage",
    "Sweep",
    "Table",
    "Value",
    "open",
    "resume",
    "run",
    "sweep",
]
