"""The command `clca compare`: energies of a run of grains beside those of a gas of the Boltzmann equation.

Bins are equally probable under chi-square, with 2 degrees of freedom in the plane and 3 in space, so that bin k of one
corresponds to bin k of the other.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy

from . import _answer
from ._chart import Look, rendered
from ._error import Error
from ._figures import Choice, chosen
from ._folder import Run, read_json
from ._table import Table

ROUNDING = 1e-6  # tables may be cut to fewer digits
MODELS = ("automaton", "contact", "voids", "baxter")


class Distribution(NamedTuple):
    name: str
    shares: list[float]  #: by bin
    samples: int

    @property
    def floor(self) -> float:
        """The distance that so many independent samples of equal distributions are expected to have."""
        return (len(self.shares) - 2) / (8 * self.samples)


def shown(number: float) -> str:
    return str(int(number)) if number.is_integer() else repr(number)


def hellinger(one: Iterable[float], other: Iterable[float]) -> float:
    return max(0.0, 1 - sum(math.sqrt(p * q) for p, q in zip(one, other)))


def run_of(folder: str, kinds: tuple[str, ...]) -> Run:
    run = Run(folder)
    if run.kind not in kinds:
        raise Error(f"{folder}: expected a run of kind {' or '.join(kinds)}, found {run.kind}")
    return run


def column_of(file: Path, table: Table, column: str) -> Any:
    if column not in (table.dtype.names or ()):
        raise Error(f"{file}: it has no column '{column}'")
    return table[column]


def shares_of(file: Path, table: Table, column: str) -> list[float]:
    """Shares of equally probable bins: their sum is 1, or all are 0."""
    numbers, reference = (column_of(file, table, name) for name in (column, "reference"))
    for name, cells in ((column, numbers), ("reference", reference)):
        if len(cells) and not (cells.dtype.kind == "f" and numpy.isfinite(cells).all()):
            raise Error(f"{file}: not all in column '{name}' are numbers")
    if len(reference) and numpy.abs(reference - 1 / len(reference)).max() > ROUNDING:
        raise Error(f"{file}: its bins are not equally probable ones (bins: q20 in the scene)")
    if (numbers < 0).any() or (numbers.any() and abs(numbers.sum() - 1) > ROUNDING):
        raise Error(f"{file}: column '{column}' holds no shares: they do not add up to 1")
    return [float(number) for number in numbers]


def of_grains(run: Run, stage: str | None) -> tuple[str, list[Distribution]]:
    """The stage, by default the last one that has a table, and its distributions."""
    found = [name for name in run.stages if f"fluctuation-{name}" in run.tables]
    if not found:
        raise Error(
            f"{run.folder}: no stage has a fluctuation table; the scene needs output.fields with a window that a stage is "
            "long enough for"
        )
    if stage is not None and stage not in found:
        raise Error(f"{run.folder}: no fluctuation table of a stage '{stage}'; there are {', '.join(found)}")
    stage = stage or found[-1]
    samples = run.stages[stage].measures.get("fluctuation_samples", math.nan)
    if not 1 <= samples < 2**64:
        raise Error(f"{run.folder / 'run.json'}: stage {stage} has no measure fluctuation_samples")
    file, table = run.folder / f"fluctuation-{stage}.csv", run.table(f"fluctuation-{stage}")
    columns = {"automaton": "share", "automaton_local": "share_local"}
    return stage, [Distribution(name, shares_of(file, table, key), int(samples)) for name, key in columns.items()]


def times_of(run: Run) -> dict[float, str]:
    """The tables `histogram-TIME` by time."""
    times = {}
    for name in run.tables:
        try:
            times[float(name.removeprefix("histogram-"))] = name
        except ValueError:
            pass
    return dict(sorted((time, name) for time, name in times.items() if math.isfinite(time)))


def of_gas(run: Run, time: float | None, restitution: float | None) -> tuple[float, list[Distribution]]:
    """The time, by default the latest one, and its distributions: no rotation of spheres that do not spin."""
    times = times_of(run)
    if not times:
        raise Error(f"{run.folder}: it has no histogram-TIME.csv; the scene needs output.histograms")
    if time is not None and time not in times:
        raise Error(
            f"{run.folder}: no histogram of time {shown(time)}; there are {', '.join(shown(one) for one in times)}"
        )
    time = list(times)[-1] if time is None else time
    file, table = run.folder / f"{times[time]}.csv", run.table(times[time])
    if "restitution" in (table.dtype.names or ()):
        all_of = [float(one) for one in numpy.unique(table["restitution"])]
        if restitution not in all_of and (restitution is not None or len(all_of) > 1):
            texts = ", ".join(shown(one) for one in all_of)
            raise Error(f"{file}: choose one of the restitutions {texts} (--restitution)")
        table = table[table["restitution"] == (all_of[0] if restitution is None and all_of else restitution)]
    elif restitution is not None:
        raise Error(f"{file}: it has no column 'restitution' to choose from")
    energies = column_of(file, table, "energy").astype(str)
    found = [
        Distribution(f"boltzmann_{energy}", shares_of(file, table[energies == energy], "share"), run.particles)
        for energy in ("translational", "rotational")
    ]
    return time, [one for one in found if any(one.shares) or one.name == "boltzmann_translational"]


def csv_of(names: Iterable[str], rows: Iterable[Iterable[Any]]) -> bytes:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(names)
    table.writerows([shown(cell) if isinstance(cell, float) else cell for cell in row] for row in rows)
    return text.getvalue().encode()


def distances_of(grains: list[Distribution], gas: list[Distribution]) -> list[tuple[str, float, float, int]]:
    """Name, distance, floor, samples: each from chi-square, then each of grains from each of the gas."""
    bins = len(grains[0].shares)
    alone = [(one.name, hellinger(one.shares, [1 / bins] * bins), one.floor, one.samples) for one in grains + gas]
    return alone + [
        (
            f"{one.name}:{other.name}",
            hellinger(one.shares, other.shares),
            one.floor + other.floor,
            min(one.samples, other.samples),
        )
        for one in grains
        for other in gas
    ]


def command(options: dict[str, Any], of_automaton: str, of_boltzmann: str, output: str) -> None:
    """Answers comparison.csv, distances.csv, a run.json and the figure of them, and a line for each distance."""
    run, other = run_of(of_automaton, MODELS), run_of(of_boltzmann, ("boltzmann",))
    stage, grains = of_grains(run, options["stage"])
    time, gas = of_gas(other, options["time"], options["restitution"])
    bins = len(grains[0].shares)
    for one in grains + gas:
        if one.samples == 0:
            raise Error(f"{other.folder}: there are no particles")
        if len(one.shares) != bins or bins < 2:
            raise Error(
                f"{other.folder}: the {one.name} energy is in {len(one.shares)} bins, that of the automaton in {bins} "
                "(bins: q20 in the scene)"
            )
    there = Path(output) / "run.json"
    if there.exists() and (kind := read_json(there).get("kind")) != "comparison":
        raise Error(f"{output}: there is a run of kind {kind} in it; write the comparison elsewhere")
    distances = distances_of(grains, gas)
    title = f"{run.scene}, {stage}, and {other.scene} at {shown(time)}"
    measures = {f"hellinger_{name}": distance for name, distance, _, _ in distances[: len(grains + gas)]}
    summary = {key: run.summary[key] for key in ("clca", "threads", "build")} | {
        "kind": "comparison",
        "scene": title,
        "title": "",
        "status": "done",
        "state_hash": f"{0:016x}",
        "stages": [{"name": stage, "steps": 0, "ended": "", "measures": measures}],
        "kinds": [],
        "measures": [],
        "tables": {},
    }
    summary |= dict.fromkeys(
        ("seed", "particles", "steps", "wall_seconds", "step_seconds", "particle_updates_per_second"), 0
    )
    rows = zip(*(one.shares for one in grains + gas))
    files = {
        "comparison.csv": csv_of(
            ["quantile_lower", "quantile_upper", *(one.name for one in grains + gas), "reference"],
            ([bin / bins, (bin + 1) / bins, *row, 1 / bins] for bin, row in enumerate(rows)),
        ),
        "distances.csv": csv_of(["name", "distance", "floor", "samples"], distances),
        "run.json": json.dumps(summary, indent=2).encode() + b"\n",
    }
    with TemporaryDirectory() as folder:
        for name, content in files.items():
            (Path(folder) / name).write_bytes(content)
        files["comparison.png"] = rendered(chosen(Run(folder), ["comparison"], Choice())[0], Look())
    for name, content in files.items():
        _answer.file(name, content)
    _answer.line(f"stage {_answer.printable(stage)} beside time {shown(time)}")
    for name, distance, floor, _ in distances:
        _answer.line(f"{name:40} D_H {distance:.3e}, floor {floor:.1e}")
