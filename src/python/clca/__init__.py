"""Granular flow by cellular automata, contact dynamics and the Boltzmann equation.

    run = clca.run("wall-removal", seed=3, set={"rules.inertia": 0.5})
    run.measures["flow"]["repose_angle_deg"]
    run.frames[-1].positions

`clca.open` reads the folder of a run or a sweep, `clca.sweep` runs a scene for many seeds and values, `clca.Simulation` takes its
steps one by one, `clca.Gas` is a gas of spheres, `clca.Scene` a scene from a dictionary. `clca explain` on the command line
lists all keys of a scene, `clca explain --format quantities` what it can measure.
"""

import importlib
from typing import TYPE_CHECKING, Any

from ._calibrate import Calibration, calibrate
from ._error import CompiledPartError, Error, compiled
from ._folder import Run, Stage, Sweep, open
from ._frames import Frame, Frames, Kind
from ._notebook import Movie, Picture, Progress
from ._table import Table, Value

if TYPE_CHECKING:
    from ._compare import compare
    from ._scene import Gas, Scene, Simulation, resume, run, sweep

    __version__: str

# Loaded when it is asked for: what runs and steps is compiled, and folders can be read without it.
_OF_SCENES = {"Gas", "Scene", "Simulation", "__version__", "resume", "run", "sweep"}


def __getattr__(name: str) -> Any:
    if name in _OF_SCENES:
        compiled(f"clca.{name}")
    elif name != "compare":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = "_scene" if name in _OF_SCENES else "_compare"
    globals()[name] = found = getattr(importlib.import_module(f".{module}", __name__), name)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *_OF_SCENES, "compare"})


__all__ = ["Calibration", "CompiledPartError", "Error", "Frame", "Frames", "Gas", "Kind", "Movie", "Picture", "Progress"]
__all__ += ["Run", "Scene", "Simulation", "Stage", "Sweep", "Table", "Value"]
__all__ += ["calibrate", "compare", "open", "resume", "run", "sweep"]
