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
from ._error import CompiledPartError, Error
from ._folder import Run, Stage, Sweep, open
from ._frames import Frame, Frames, Kind
from ._picture import Picture
from ._table import Table, Value

if TYPE_CHECKING:
    from ._gas import Gas
    from ._scene import Scene
    from ._simulation import Simulation
    from ._start import resume, run, sweep

    __version__: str

# What runs and steps is compiled, and loaded when it is asked for: folders can be read without it.
_COMPILED = {
    "Gas": "_gas",
    "Scene": "_scene",
    "Simulation": "_simulation",
    "resume": "_start",
    "run": "_start",
    "sweep": "_start",
}


def __getattr__(name: str) -> Any:
    try:
        if name == "__version__":
            found = importlib.import_module("._clca", __name__).version()
        elif name in _COMPILED:
            found = getattr(importlib.import_module(f".{_COMPILED[name]}", __name__), name)
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    except ImportError as error:
        raise CompiledPartError(f"clca.{name}", error) from None
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *_COMPILED, "__version__"})


__all__ = [
    "Calibration",
    "CompiledPartError",
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
    "calibrate",
    "open",
    "resume",
    "run",
    "sweep",
]
