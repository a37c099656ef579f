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
from ._error import CompiledPartError, Error, compiled_module
from ._folder import Run, Stage, Sweep, open
from ._frames import Frame, Frames, Kind
from ._notebook import Movie, Picture, Progress
from ._table import Table, Value

if TYPE_CHECKING:
    from ._compare import compare
    from ._scene import Gas, Scene, Simulation, resume, run, sweep

    __version__: str

# Loaded when it is asked for: what runs and steps is compiled, and folders can be read without it.
_NAMES = ("Gas", "Scene", "Simulation", "__version__", "resume", "run", "sweep")
_MODULE_OF = {"compare": "_compare"} | dict.fromkeys(_NAMES, "_scene")


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if _MODULE_OF[name] == "_scene":
        compiled_module(f"clca.{name}")
    globals()[name] = found = getattr(importlib.import_module(f".{_MODULE_OF[name]}", __name__), name)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULE_OF})


__all__ = ["Calibration", "CompiledPartError", "Error", "Frame", "Frames", "Gas", "Kind", "Movie", "Picture", "Progress"]
__all__ += ["Run", "Scene", "Simulation", "Stage", "Sweep", "Table", "Value"]
__all__ += ["calibrate", "compare", "open", "resume", "run", "sweep"]
