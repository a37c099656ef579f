"""Many runs: seeds and values."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from . import _clca
from ._arguments import MOST, at_most_runs, path, whole
from ._run import Run
from ._scene import AnyScene, Scene, to_yaml
from ._table import TEXT, Table


class Sweep:
    """The runs of a sweep and tables over them."""

    def __init__(self, folder: Path, keys: list[str], runs: list[tuple[list[str], int, Path]]) -> None:
        self.folder = folder.absolute()
        self.keys = keys  #: that vary
        self._runs = [(values, seed, run.absolute()) for values, seed, run in runs]

    def __repr__(self) -> str:
        return f"<sweep {self.folder}: {len(self._runs)} runs>"

    def _table(self, name: str) -> Table:
        done = [folder for _, _, folder in self._runs if (folder / "run.json").exists()]
        return Table(_clca.table(self.folder, name, TEXT, done[0] if done else None))

    @cached_property
    def runs(self) -> Table:
        """`runs.csv`, a row for each run: what varies, seed, status, `STAGE.MEASURE` of each measure, error."""
        return self._table("runs")

    @cached_property
    def measures(self) -> Table:
        """`measures.csv`, a row for each combination, stage and measure: mean, standard error ... over the seeds."""
        return self._table("measures")

    def __len__(self) -> int:
        return len(self._runs)

    def __getitem__(self, number: int) -> Run:
        """The run of a row of `runs`."""
        return Run(self._runs[number][2])

    def __iter__(self) -> Iterator[Run]:
        return (self[number] for number in range(len(self)))

    def series(self, stage: str, column: str) -> Table:
        """A column of `series.csv` in a stage, for each combination averaged over the seeds, as in `mean-series.csv`: `step`
        since the stage began, `mean`, `standard_error` and `runs`. It goes as far as all runs do. NaN is the error of a
        single run.
        """
        table = self._table("mean-series")
        rows = table[table["stage"] == stage]
        names = {key: key for key in (*self.keys, "step")} | {"mean": column, "standard_error": f"{column}_se", "runs": "runs"}
        units = {key: ("", table.units[column], table.descriptions[column]) for key in ("mean", "standard_error")}
        return Table([(key, rows[name], units.get(key, ("", "", ""))) for key, name in names.items()])


def sweep(
    scene: AnyScene,
    seeds: Iterable[int] = range(1, 9),
    vary: Mapping[str | tuple[str, ...], Sequence[Any]] | None = None,
    set: Mapping[str, Any] | None = None,
    output: str | os.PathLike[str] | None = None,
    jobs: int | None = None,
) -> Sweep:
    """Runs a scene for all combinations of values with all seeds, as `clca sweep` does, several at a time.

    `vary`: the values of each key; those of several keys that vary together go by a tuple of keys, and are tuples.
    `output` is the folder, `renders/NAME-sweep` by default; runs that are there already are not run again. `jobs`: runs
    at a time, one for each thread of the machine by default.

    A run that fails is a warning, and has its `error` in the table. Ctrl-C stops the sweep; the same call goes on with
    it. Throws Error.
    """
    if not isinstance(scene, Scene):
        scene = Scene(scene, set=set)
    elif set:
        scene = Scene.of(scene, set=set)
    varied = []
    for keys, values in (vary or {}).items():
        if isinstance(keys, str):
            varied.append(([keys], [[to_yaml(value)] for value in at_most_runs(keys, values)]))
        else:
            rows = at_most_runs(",".join(keys), values)
            varied.append((list(keys), [[to_yaml(value) for value in row] for row in rows]))
    numbers = [whole("seeds", seed, 0, MOST) for seed in at_most_runs("seeds", seeds)]
    folder = None if output is None else path(output)
    at_a_time = None if jobs is None else whole("jobs", jobs, 1, 1024)
    return Sweep(*_clca.sweep(*scene._origin, scene._as_options(), varied, numbers, folder, at_a_time))
