"""Scenes, and the runs, sweeps, simulations and gases that are made from them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from functools import cached_property, partial
from typing import Any

import numpy
from numpy.typing import NDArray

from . import _clca
from ._arguments import MAX_U64, absolute_path, argument_error, checked_flag, checked_mapping, checked_number, checked_path
from ._arguments import checked_run_list, checked_text, checked_whole, checked_workers, to_yaml
from ._error import ArgumentError, Error
from ._folder import Run, Sweep
from ._frames import PITCH, Frame, Kind, RunFacts, Trajectory
from ._notebook import Picture, Progress, frame_overrides, progress_reporter
from ._table import Quantity, Table, Value

__version__ = _clca.version()


def override_texts(seed: int | None, set: Mapping[str, Any] | None) -> dict[str, str]:
    """Returns replaced keys and their values in the syntax of a scene."""
    keys = checked_mapping("set", set) | ({} if seed is None else {"seed": seed})
    return {checked_text("set", key): to_yaml(key, value) for key, value in keys.items()}


class Scene(_clca.Scene):
    """A scene with everything checked, as by `clca check`.

    `source` is a file, the name of a scene that comes with clca, or a dictionary as a scene file has it; what is changed
    there afterwards is for the next scene, but pictures and runs that the scene names are read when it is used. `set` replaces
    keys, as `--set`: `{"rules.inertia": 0.5, "stages.flow.max_steps": 500}`. Messages about a dictionary give its lines as
    `json.dumps(source, indent=1)` has them. Throws Error.
    """

    def __init__(
        self, source: str | os.PathLike[str] | Mapping[str, Any], seed: int | None = None, set: Mapping[str, Any] | None = None,
        name: str = "scene"
    ) -> None:
        if isinstance(source, Mapping):
            file, content = checked_path(name), to_yaml("scene", source, indent=1).encode()
        else:
            file, content = checked_path(source), None
        self._load(os.fsencode(file), content, override_texts(seed, set))

    def _load(self, file: bytes, text: bytes | None, overrides: dict[str, str]) -> None:
        self._overrides = overrides
        self._options = [f"{key}={value}".encode() for key, value in overrides.items()]  # as for --set
        super().__init__(file, text, self._options)

    @classmethod
    def _again(cls, file: bytes, text: bytes, overrides: dict[str, str]) -> Scene:
        """Makes a scene from the source of another one."""
        scene = cls.__new__(cls)
        scene._load(file, text, overrides)
        return scene

    @classmethod
    def of(cls, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None) -> Scene:
        """`scene`, if it is one, with more keys replaced; else the scene from that source."""
        if not isinstance(scene, Scene):
            return cls(scene, seed, set)
        if seed is None and not set:
            return scene
        return cls._again(*scene._origin, scene._overrides | override_texts(seed, set))

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene._again, (*self._origin, self._overrides)

    def __repr__(self) -> str:
        return f"<scene {self.name}>"


#: A scene, a file, the name of a scene that comes with clca, or a dictionary.
AnyScene = Scene | str | os.PathLike[str] | Mapping[str, Any]


def run(
    scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None, output: str | os.PathLike[str] | None = None,
    threads: int | None = None, keep: bool = False, overwrite: bool = False,
    progress: bool | Callable[[Progress], object] = False
) -> Run:
    """Runs a scene, as `clca run` and `clca boltzmann` do, with the same bits.

    `scene`, `seed` and `set` are as for `Scene`; `output` is the folder, `renders/NAME` by default. `threads`: 1 for
    grains, all for a gas by default. `keep` leaves an earlier run in the folder alone and writes to FOLDER-2, ...;
    `overwrite` also replaces one that could be resumed. `progress`: True for a bar on standard error, or what is called with
    a `Progress` some ten times a second.

    Ctrl-C ends the run as on the command line: with complete files and a checkpoint, for `resume`; then it raises
    KeyboardInterrupt. Throws Error. Warnings of the run are Python's.
    """
    if all([checked_flag("keep", keep), checked_flag("overwrite", overwrite)]):
        raise ArgumentError("keep excludes overwrite")
    if output is not None:
        output = absolute_path(output)
    with progress_reporter(progress) as report:
        checked = Scene.of(scene, seed, set)
        folder = output or absolute_path(f"renders/{checked.name}")
        return Run(_clca.run(checked, str(folder), checked_workers("threads", threads), keep, overwrite, report))


def resume(
    folder: str | os.PathLike[str], until: Any = None, threads: int | None = None,
    progress: bool | Callable[[Progress], object] = False
) -> Run:
    """Goes on with a run that was stopped, or prolongs one to `until`, as in a scene. As `clca resume`; `progress` as of `run`."""
    folder = absolute_path(folder)
    with progress_reporter(progress) as report:
        _clca.resume(str(folder), None if until is None else to_yaml("until", until), checked_workers("threads", threads), report)
    return Run(folder)


def sweep(
    scene: AnyScene, seeds: Iterable[int] = range(1, 9), vary: Mapping[str | tuple[str, ...], Sequence[Any]] | None = None,
    set: Mapping[str, Any] | None = None, output: str | os.PathLike[str] | None = None, jobs: int | None = None,
    progress: bool | Callable[[Progress], object] = False
) -> Sweep:
    """Runs a scene for all combinations of values with all seeds, as `clca sweep` does, several at a time.

    `vary`: the values of each key; those of several keys that vary together go by a tuple of keys, and are tuples.
    `output` is the folder, `renders/NAME-sweep` by default; runs that are there already are not run again. `jobs`: runs
    at a time, one for each thread of the machine by default; `progress` is as for `run`.

    A run that fails is a warning, and has its `error` in the table. Ctrl-C stops the sweep; the same call goes on with
    it. Throws Error.
    """
    checked, varied = Scene.of(scene, set=set), []
    for keys, values in checked_mapping("vary", vary).items():
        of = [checked_text("vary", key) for key in ([keys] if isinstance(keys, str) else checked_run_list("vary", keys))]
        if not of:
            raise ArgumentError("vary: expected keys, found none")
        name = ",".join(of)
        rows = checked_run_list(name, values)
        lists = [[row] if isinstance(keys, str) else checked_run_list(name, row) for row in rows]
        varied.append((of, [[to_yaml(name, value) for value in row] for row in lists]))
    numbers = [checked_whole("seeds", seed, 0, MAX_U64) for seed in checked_run_list("seeds", seeds)]
    folder = absolute_path(f"renders/{checked.name}-sweep" if output is None else output)
    with progress_reporter(progress) as report:
        # A text: Ctrl-C in the middle of a path's __fspath__ would be a TypeError.
        _clca.sweep(*checked._origin, checked._options, varied, numbers, str(folder), checked_workers("jobs", jobs), report)
    return Sweep(folder)


class Simulation(_clca.Simulation):
    """A scene of grains, of which you take the steps: with the bits of a run, without its files.

    `scene`, `seed` and `set` are as for `Scene`. Throws Error. After `step` or `next_stage` has failed, later calls throw
    the same.
    """

    def __init__(self, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None, threads: int = 1) -> None:
        super().__init__(Scene.of(scene, seed, set), checked_whole("threads", threads, 1, 1024))

    def __repr__(self) -> str:
        try:
            return f"<simulation at step {self.steps}, stage {self.stage}>"
        except Error as error:
            return f"<simulation that has failed: {error}>"

    def step(self, steps: int = 1) -> int:
        """Takes so many steps, and begins stages where others have ended. Returns how many were taken: fewer if the last
        stage has ended.
        """
        is_plain = type(steps) is int and 0 <= steps <= MAX_U64  # without a call: single steps are short
        return self._step(steps if is_plain else checked_whole("steps", steps, 0, MAX_U64))

    def _now(self) -> Trajectory:
        """Returns a trajectory of one frame, the present state."""
        return Trajectory([partial(nullcontext, self._datasets())], self._summary())

    @cached_property
    def _facts(self) -> RunFacts:
        return self._now().facts

    @property
    def kinds(self) -> list[Kind]:
        """The kinds of particles, by their number in `particles`."""
        return self._facts.kinds

    @property
    def walls(self) -> dict[str, NDArray[numpy.float64]]:
        """Of each wall sites x 2: their positions at home, in lattice spacings."""
        return self._facts.walls

    @property
    def frame(self) -> Frame:
        """The particles in the box as they are now, as of a run; a copy."""
        return Frame(self._now(), 0)

    @property
    def measures(self) -> dict[str, Value]:
        """The measures of the stage as of now, as in `run.json`."""
        return {key: Value(number, *what) for key, number, *what in self._measures(None)}

    def measure(self, name: str) -> dict[str, Value] | Table:
        """One of the measures of the scene's key `measure`: its values by name; of `profile` a table of the free
        surface, with `x` and `height` in lattice spacings. Throws Error if the scene does not have it.
        """
        if name == "profile":
            heights = numpy.array(self._heights())
            x = "x", PITCH * numpy.arange(len(heights)), Quantity("Position", "spacings")
            return Table([x, ("height", heights, Quantity("Height of the surface", "spacings"))])
        return {key: Value(number, *what) for key, number, *what in self._measures(checked_text("name", name))}

    def picture(self, **frames: Any) -> Picture:
        """The box as it is now. `frames` are keys of `output.frames` in place of the scene's, such as
        `color_by="stage_layer"`, `width=400`. Throws Error.
        """
        return self._picture(frame_overrides(frames)).view(Picture)


class Gas(_clca.Gas):
    """The first gas of the ensemble of a scene of the Boltzmann equation, with its first restitution.

    `scene`, `seed` and `set` are as for `Scene`. Velocities are in v0, the root of <v^2>/3 at time 0, and times in the
    unit of docs/boltzmann.md. `threads`: all by default; the bits do not depend on it. Throws Error.
    """

    def __init__(
        self, scene: AnyScene, seed: int | None = None, set: Mapping[str, Any] | None = None, threads: int | None = None
    ) -> None:
        super().__init__(Scene.of(scene, seed, set), checked_workers("threads", threads))

    def advance(self, time: float) -> None:
        """Advances to this time, which is not before that of the gas. The bits equal those of a run that also stops here: the
        times of observation are the run's stops.
        """
        until, now = checked_number("time", time), self.time
        if until < now:
            raise argument_error("time", f"{now:g} or later", time)
        self._advance(until)

    def __repr__(self) -> str:
        try:
            return f"<gas at time {self.time:g}>"
        except Error as error:
            return f"<gas that has failed: {error}>"
