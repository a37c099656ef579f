"""Compares energies of a run of grains with those of a gas of the Boltzmann equation.

Bins are equally probable under chi-square, with 2 degrees of freedom in the plane and 3 in space, so that bin k of one
corresponds to bin k of the other.
"""

import json
import math
import os
import re
from collections.abc import Iterable
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy

from . import _answer
from ._arguments import absolute_path, checked_number, checked_text
from ._chart import FileFormat, figure_bytes
from ._error import Error, printable
from ._figures import FigureChoice, chosen_charts
from ._folder import Run, read_json, refuse_other_kind, write_files
from ._table import Table, csv_bytes

ROUNDING = 1e-6  # tables may be cut to fewer digits


class Distribution(NamedTuple):
    name: str
    shares: list[float]  #: by bin
    samples: int

    @property
    def expected_distance(self) -> float:
        """Returns the expected distance of two samples of this size from one distribution."""
        return (len(self.shares) - 2) / (8 * self.samples)


def short_number(number: float) -> str:
    return str(int(number)) if number.is_integer() else repr(number)


def hellinger(one: Iterable[float], other: Iterable[float]) -> float:
    return max(0.0, 1 - sum(math.sqrt(p * q) for p, q in zip(one, other)))


def checked_run(folder: Run | str | os.PathLike[str], what: str) -> Run:
    """Returns the run. Throws Error unless it is of `what`: grains or a gas."""
    run = folder if isinstance(folder, Run) else Run(folder)
    if (run.kind == "boltzmann") != (what == "a gas"):
        name = folder.folder if isinstance(folder, Run) else os.fspath(folder)
        raise Error(f"{name}: expected a run of {what}, found one of kind {run.kind}")
    return run


def shares_of(table: Table, column: str) -> list[float]:
    """Returns the shares of equally probable bins; their sum is 1, or all are 0."""
    table._check_numbers(column, "reference")
    shares, reference = table[column], table["reference"]
    if not (abs(reference - 1 / max(len(reference), 1)) <= ROUNDING).all():
        raise Error(f"{table._file}: its bins are not equally probable ones (bins: q20 in the scene)")
    if not (shares >= 0).all() or (shares.any() and abs(shares.sum() - 1) > ROUNDING):
        raise Error(f"{table._file}: column '{column}' holds no shares: they do not add up to 1")
    return [float(share) for share in shares]


def distributions_of_grains(run: Run, stage: str | None) -> tuple[str, list[Distribution]]:
    """Returns the stage, by default the last one with a table, and its distributions."""
    found = [name for name in run.stages if f"fluctuation-{name}" in run.tables]
    if not found:
        needs = "the scene needs output.fields with a window that a stage is long enough for"
        raise Error(f"{run.folder}: no stage has a fluctuation table; {needs}")
    if stage is not None and stage not in found:
        raise Error(f"{run.folder}: no fluctuation table of a stage '{stage}'; there are {', '.join(found)}")
    stage = stage or found[-1]
    samples = int(run.stages[stage].measures["fluctuation_samples"])
    table = run.table(f"fluctuation-{stage}")
    columns = {"automaton": "share", "automaton_local": "share_local"}
    return stage, [Distribution(name, shares_of(table, key), samples) for name, key in columns.items()]


def distributions_of_gas(run: Run, time: float | None, restitution: float | None) -> tuple[float, list[Distribution]]:
    """Returns the time, by default the latest, and its distributions: of rotation only if spheres spin."""
    found = [(re.fullmatch(r"histogram-(\d+(?:\.\d+)?(?:e[+-]?\d+)?)", name), name) for name in run.tables]
    times = {float(match[1]): name for match, name in found if match}
    if not times:
        raise Error(f"{run.folder}: it has no histogram-TIME.csv; the scene needs output.histograms")
    if time is not None and time not in times:
        there = ", ".join(map(short_number, sorted(times)))
        raise Error(f"{run.folder}: no histogram of time {short_number(time)}; there are {there}")
    time = max(times) if time is None else time
    table = run.table(times[time])
    if "restitution" in table.names or restitution is not None:
        all_of = list(map(short_number, numpy.unique(table["restitution"]).astype(float).tolist()))
        wanted = short_number(float(restitution)) if restitution is not None else all_of[0] if len(all_of) == 1 else ""
        if wanted not in all_of:
            raise Error(f"{table._file}: choose one of the restitutions {', '.join(all_of)} (--restitution)")
        table = table[table["restitution"] == float(wanted)]
    energies = table["energy"].astype(str)
    names = ("translational", "rotational")
    shares = {name: shares_of(table[energies == name], "share") for name in names}
    shown_names = [name for name in names if any(shares[name]) or name == names[0]]
    return time, [Distribution(f"boltzmann_{name}", shares[name], run.particles) for name in shown_names]


def comparison_files(
    run: Run, other: Run, output: Path, stage: str | None, time: float | None, restitution: float | None
) -> tuple[dict[str, bytes], list[str]]:
    """Returns comparison.csv, distances.csv and a run.json for the folder, and lines to print."""
    stage, grains = distributions_of_grains(run, stage)
    time, gas = distributions_of_gas(other, time, restitution)
    bins = len(grains[0].shares)
    for folder, one in [(run.folder, one) for one in grains] + [(other.folder, one) for one in gas]:
        if one.samples == 0:
            raise Error(f"{folder}: there are no particles")
        if len(one.shares) != bins or bins < 2:
            of = f"the {one.name} energy is in {len(one.shares)} bins, that of the automaton in {bins}"
            raise Error(f"{folder}: {of} (bins: q20 in the scene)")
    refuse_other_kind(output, "run.json")
    there = output / "run.json"
    if there.exists() and (kind := read_json(there).get("kind")) != "comparison":
        raise Error(f"{output}: there is a run of kind {kind} in it; write the comparison elsewhere")
    # Name, distance, floor, samples: each from chi-square, then each of grains from each of the gas.
    distances = [(one.name, hellinger(one.shares, [1 / bins] * bins), one.expected_distance, one.samples) for one in grains + gas]
    for one, two in product(grains, gas):
        distance, samples = hellinger(one.shares, two.shares), min(one.samples, two.samples)
        distances.append((f"{one.name}:{two.name}", distance, one.expected_distance + two.expected_distance, samples))
    measures = {f"hellinger_{name}": distance for name, distance, _, _ in distances[: len(grains + gas)]}
    summary = {key: run.summary[key] for key in ("clca", "threads", "build")}
    summary |= {"kind": "comparison", "scene": f"{run.scene}, {stage}, and {other.scene} at {short_number(time)}"}
    summary |= {"title": "", "status": "done", "state_hash": f"{0:016x}"}
    summary |= {"stages": [{"name": stage, "steps": 0, "ended": "", "measures": measures}]}
    summary |= {"kinds": [], "measures": [], "tables": {}}
    numbers = ("seed", "particles", "steps", "wall_seconds", "step_seconds", "particle_updates_per_second")
    summary |= dict.fromkeys(numbers, 0)
    rows = enumerate(zip(*(one.shares for one in grains + gas)))
    names = ["quantile_lower", "quantile_upper", *(one.name for one in grains + gas), "reference"]
    said = [f"{name:40} D_H {distance:.3e}, floor {floor:.1e}" for name, distance, floor, _ in distances]
    return {
        "comparison.csv": csv_bytes(names, *([i / bins, (i + 1) / bins, *row, 1 / bins] for i, row in rows)),
        "distances.csv": csv_bytes(["name", "distance", "floor", "samples"], *distances),
        "run.json": json.dumps(summary, indent=2).encode() + b"\n",
    }, [f"stage {printable(stage)} beside time {short_number(time)}", *said]


def compare(
    automaton: Run | str | os.PathLike[str], boltzmann: Run | str | os.PathLike[str],
    output: str | os.PathLike[str] = "renders/comparison", stage: str | None = None, time: float | None = None,
    restitution: float | None = None
) -> Run:
    """Energies of a run of grains with `output.fields` beside those of a gas with `output.histograms`, as `clca compare`.

    Writes tables into the folder `output` and returns it as a run: `table("comparison")` has the shares by bin,
    `table("distances")` how far each is from chi-square and from the others; `plot("comparison")` is the figure. By
    default `stage` is the last one that has a table, `time` the latest. Throws Error.
    """
    folder = absolute_path(output)
    grains, gas = checked_run(automaton, "grains"), checked_run(boltzmann, "a gas")
    numbers = [None if one is None else checked_number(name, one) for name, one in (("time", time), ("restitution", restitution))]
    files, _ = comparison_files(grains, gas, folder, None if stage is None else checked_text("stage", stage), *numbers)
    write_files(folder, files.items())
    return Run(folder)


def command(options: dict[str, Any], of_automaton: str, of_boltzmann: str, output: str) -> None:
    """Answers with the tables, their figure, and a line for each distance."""
    time, restitution = (float(options[key]) if key in options else None for key in ("time", "restitution"))
    runs = checked_run(of_automaton, "grains"), checked_run(of_boltzmann, "a gas")
    files, said = comparison_files(*runs, Path(output), options.get("stage"), time, restitution)
    with TemporaryDirectory() as folder:
        for name, content in files.items():
            (Path(folder) / name).write_bytes(content)
        files["comparison.png"] = figure_bytes(chosen_charts(Run(folder), ["comparison"], FigureChoice())[0], FileFormat())
    _answer.send_files_and_lines(files.items(), said)
