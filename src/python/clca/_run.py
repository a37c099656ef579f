"""Runs: carried out, gone on with, read."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from . import _arguments as arguments
from . import _clca
from ._arguments import MOST, absolute, path, whole
from ._error import ArgumentError, Error
from ._frames import Frames, Kind
from ._picture import Picture, overrides
from ._scene import AnyScene, Scene, to_yaml
from ._table import TEXT, Named, Table, Value


class Stage(NamedTuple):
    """How a stage of a run went."""

    steps: int
    ended: str  #: settled, stalled, steps, time, discharged, cycles, bound or interrupted
    measures: dict[str, Value]  #: by their names in run.json
    notes: list[str]  #: why a measure has no value


class Run:
    """A run folder. Tables and frames are read when they are asked for.

    `folder` is absolute, so that it stays the same one.
    """

    kind: str  #: automaton, contact, voids, baxter or boltzmann
    scene: str  #: its name
    title: str
    version: str  #: of clca
    seed: int
    status: str  #: running, done, interrupted or failed
    particles: int
    steps: int
    state_hash: int  #: of the last state: equal for equal bits

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = absolute(folder)
        summary = _clca.summary(self.folder)
        self.stages = {
            name: Stage(
                steps, ended, Named("measure", ((key, Value(number, *what)) for key, number, what in measures)), notes
            )
            for name, steps, ended, measures, notes in summary.pop("stages")
        }
        self.__dict__.update(summary)

    def __repr__(self) -> str:
        return f"<run {self.folder}: {self.scene}, seed {self.seed}, {self.status} after {self.steps} steps>"

    @property
    def measures(self) -> dict[str, dict[str, Value]]:
        """By stage, then by the names of `run.json`: `measures["flow"]["runout_99"]`. `clca explain --format quantities` lists
        what a scene can measure.
        """
        return Named("stage", ((name, stage.measures) for name, stage in self.stages.items()))

    @property
    def tables(self) -> list[str]:
        """Names for `table`."""
        if not self.folder.is_dir():
            raise Error(f"cannot read {self.folder}: the folder is not there")
        return sorted(file.stem for file in self.folder.glob("*.csv"))

    def table(self, name: str) -> Table:
        """`NAME.csv` of the folder, such as `profile-flow`. Numbers are float64; an empty cell is NaN. Throws Error."""
        if name not in self.tables:
            raise Error(f"{self.folder}: no table {name!r}; there are {', '.join(self.tables) or 'none'}")
        return Table(_clca.table(self.folder, name, TEXT, self.folder))

    @cached_property
    def series(self) -> Table:
        """`series.csv`: a row for each step, as `output.series` of the scene says; Error without one."""
        return self.table("series")

    @cached_property
    def frames(self) -> Frames:
        """The trajectory, where the scene has `output.trajectory`: `frames[-1]` is the last frame, `frames.at(step)` that
        of a step. Throws Error without one.
        """
        return Frames(_clca.Trajectory(self.folder))

    @property
    def kinds(self) -> list[Kind]:
        """The kinds of particles, by their number in a frame."""
        return self.frames._look.kinds

    @property
    def walls(self) -> dict[str, NDArray[numpy.float64]]:
        """Of each wall sites x 2: their positions at home, in lattice spacings."""
        return self.frames._look.walls

    def contacts(self, step: int) -> NDArray[numpy.void]:
        """`contacts` of the frame of that step."""
        return self.frames.at(step).contacts

    def picture(self, step: int, **frames: Any) -> Picture:
        """The box at a step of the trajectory. `frames` are keys of `output.frames` in place of the scene's, such as
        `color_by="stage_layer"`, `width=400`. Throws Error.
        """
        return _clca.picture(self.folder, whole("step", step, 0, MOST), overrides(frames)).view(Picture)

    def movie(self, file: str | os.PathLike[str], fps: int = 25, duration: float | None = None, **frames: Any) -> None:
        """Writes the pictures of the run, drawn from its trajectory, to FILE.mp4, .webm, .webp, .gif or .png
        (animated), by ffmpeg. `frames` are as for `picture`; `every` chooses the steps. `duration`, seconds: shows
        frames of the trajectory evenly chosen, at most `fps` per second. Throws Error.
        """
        if duration is not None:
            if not 0.1 <= duration <= 86_400:
                raise ArgumentError(f"duration: expected 0.1 to 86400 seconds, found {duration:g}")
            frames = {"every": 1, **frames}
        _clca.movie(self.folder, path(file), whole("fps", fps, 1, 240), duration, overrides(frames))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "frames"}  # of an open trajectory


def open(folder: str | os.PathLike[str]) -> Run:
    """The run in a folder, also one that is under way. Throws Error if there is none."""
    return Run(folder)


def run(
    scene: AnyScene,
    seed: int | None = None,
    set: Mapping[str, Any] | None = None,
    output: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    keep: bool = False,
    overwrite: bool = False,
) -> Run:
    """Runs a scene, as `clca run` and `clca boltzmann` do, with the same bits.

    `scene`, `seed` and `set` are as for `Scene`; `output` is the folder, `renders/NAME` by default. `threads`: 1 for
    grains, all for a gas by default. `keep` leaves an earlier run in the folder alone and writes to FOLDER-2, ...;
    `overwrite` also replaces one that could be resumed.

    Ctrl-C ends the run as on the command line: with complete files and a checkpoint, for `resume`; then it raises
    KeyboardInterrupt. Throws Error. Warnings of the run are Python's.
    """
    if keep and overwrite:
        raise ArgumentError("keep excludes overwrite")
    folder = None if output is None else path(output)
    return Run(_clca.run(Scene.of(scene, seed, set), folder, arguments.threads(threads), keep, overwrite))


def resume(folder: str | os.PathLike[str], until: Any = None, threads: int | None = None) -> Run:
    """Goes on with a run that was stopped, or prolongs one to `until`, as in a scene. As `clca resume`."""
    _clca.resume(path(folder), None if until is None else to_yaml(until), arguments.threads(threads))
    return Run(folder)
