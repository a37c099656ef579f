"""Scenes step by step, and gases."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from functools import cached_property, partial
from typing import Any

import numpy
from numpy.typing import NDArray

from . import _clca
from ._arguments import MOST, number, refused, text, whole, workers
from ._error import Error
from ._frames import Frame, Kind, Look
from ._notebook import Picture, overrides
from ._scene import AnyScene, Scene
from ._table import Quantity, Table, Value
from ._trajectory import PITCH, Trajectory


class Simulation(_clca.Simulation):
    """A scene of grains, of which you take the steps: with the bits of a run, without its files.

    `scene`, `seed` and `set` are as for `Scene`. Throws Error. After `step` or `next_stage` has failed, later calls throw
    the same.
    """

    def __init__(self, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None, threads: int = 1) -> None:
        super().__init__(Scene.of(scene, seed, set), whole("threads", threads, 1, 1024))

    def __repr__(self) -> str:
        try:
            return f"<simulation at step {self.steps}, stage {self.stage}>"
        except Error as error:
            return f"<simulation that has failed: {error}>"

    def step(self, steps: int = 1) -> int:
        """Takes so many steps, and begins stages where others have ended. Returns how many were taken: fewer if the last
        stage has ended.
        """
        return self._step(steps) if type(steps) is int and 0 <= steps <= MOST else self._step(whole("steps", steps, 0, MOST))

    def _now(self) -> Trajectory:
        """Of one frame: what is there now."""
        return Trajectory([partial(nullcontext, self._datasets())], self._summary())

    @cached_property
    def _look(self) -> Look:
        return self._now().look

    @property
    def kinds(self) -> list[Kind]:
        """The kinds of particles, by their number in `particles`."""
        return self._look.kinds

    @property
    def walls(self) -> dict[str, NDArray[numpy.float64]]:
        """Of each wall sites x 2: their positions at home, in lattice spacings."""
        return self._look.walls

    @property
    def frame(self) -> Frame:
        """The particles in the box as they are now, as of a run; a copy."""
        return Frame(self._now(), 0)

    @property
    def measures(self) -> dict[str, Value]:
        """What a run has of its stage, taken as of now."""
        return {key: Value(number, *what) for key, number, *what in self._measures(None)}

    def measure(self, name: str) -> dict[str, Value] | Table:
        """One of the measures of the scene's key `measure`: its values by name; of `profile` a table of the free
        surface, with `x` and `height` in lattice spacings. Throws Error if the scene does not have it.
        """
        if name == "profile":
            heights = self._heights()
            x = "x", PITCH * numpy.arange(len(heights)), Quantity("Position", "spacings")
            return Table([x, ("height", heights, Quantity("Height of the surface", "spacings"))])
        return {key: Value(number, *what) for key, number, *what in self._measures(text("name", name))}

    def picture(self, **frames: Any) -> Picture:
        """The box as it is now. `frames` are keys of `output.frames` in place of the scene's, such as
        `color_by="stage_layer"`, `width=400`. Throws Error.
        """
        return self._picture(overrides(frames)).view(Picture)


class Gas(_clca.Gas):
    """The first gas of the ensemble of a scene of the Boltzmann equation, with its first restitution.

    `scene`, `seed` and `set` are as for `Scene`. Velocities are in v0, the root of <v^2>/3 at time 0, and times in the
    unit of docs/boltzmann.md. `threads`: all by default; the bits do not depend on it. Throws Error.
    """

    def __init__(
        self, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None, threads: int | None = None
    ) -> None:
        super().__init__(Scene.of(scene, seed, set), workers("threads", threads))

    def advance(self, time: float) -> None:
        """Goes on to this time, which is not before that of the gas. The bits are those of a run where that also stops at it: its
        times of observation.
        """
        until, now = number("time", time), self.time
        if until < now:
            raise refused("time", f"{now:g} or later", time)
        self._advance(until)

    def __repr__(self) -> str:
        try:
            return f"<gas at time {self.time:g}>"
        except Error as error:
            return f"<gas that has failed: {error}>"
