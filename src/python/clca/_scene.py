"""Scenes, and the runs and sweeps of them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from . import _clca
from ._arguments import MOST, absolute, at_most_runs, flag, mapping, path, text, to_yaml, whole, workers
from ._error import ArgumentError
from ._folder import Run, Sweep
from ._notebook import Progress, reporting


def overrides(seed: int | None, set: Mapping[str, Any] | None) -> dict[str, str]:
    """Keys and their values in the syntax of a scene."""
    keys = mapping("set", set) | ({} if seed is None else {"seed": seed})
    return {text("set", key): to_yaml(key, value) for key, value in keys.items()}


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
            file, content = path(name), to_yaml("scene", source, indent=1).encode()
        else:
            file, content = path(source), None
        self._load(os.fsencode(file), content, overrides(seed, set))

    def _load(self, file: bytes, text: bytes | None, overrides: dict[str, str]) -> None:
        self._overrides = overrides
        super().__init__(file, text, self._as_options())

    def _as_options(self) -> list[bytes]:
        """As for `--set`."""
        return [f"{key}={value}".encode() for key, value in self._overrides.items()]

    @classmethod
    def _again(cls, file: bytes, text: bytes, overrides: dict[str, str]) -> Scene:
        """From what another one was made of."""
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
        return cls._again(*scene._origin, scene._overrides | overrides(seed, set))

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
    if all([flag("keep", keep), flag("overwrite", overwrite)]):
        raise ArgumentError("keep excludes overwrite")
    folder = None if output is None else path(output)
    with reporting(progress) as report:
        return Run(_clca.run(Scene.of(scene, seed, set), folder, workers("threads", threads), keep, overwrite, report))


def resume(
    folder: str | os.PathLike[str], until: Any = None, threads: int | None = None,
    progress: bool | Callable[[Progress], object] = False
) -> Run:
    """Goes on with a run that was stopped, or prolongs one to `until`, as in a scene. As `clca resume`; `progress` as of `run`."""
    folder = absolute(folder)
    with reporting(progress) as report:
        _clca.resume(folder, None if until is None else to_yaml("until", until), workers("threads", threads), report)
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
    for keys, values in mapping("vary", vary).items():
        of = [text("vary", key) for key in ([keys] if isinstance(keys, str) else at_most_runs("vary", keys))]
        if not of:
            raise ArgumentError("vary: expected keys, found none")
        name = ",".join(of)
        rows = at_most_runs(name, values)
        lists = [[row] if isinstance(keys, str) else at_most_runs(name, row) for row in rows]
        varied.append((of, [[to_yaml(name, value) for value in row] for row in lists]))
    numbers = [whole("seeds", seed, 0, MOST) for seed in at_most_runs("seeds", seeds)]
    folder = None if output is None else path(output)
    with reporting(progress) as report:
        of_scene = *checked._origin, checked._as_options()
        return Sweep(_clca.sweep(*of_scene, varied, numbers, folder, workers("jobs", jobs), report))
