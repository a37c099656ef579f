"""The runs of a calibration: what has to be run next, what came out, and the answer that follows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy

from ._arguments import suggestion
from ._error import Error
from ._folder import Sweep
from ._study import Study, Test
from ._surrogate import Numbers, Posterior, Surrogate, posterior, sobol
from ._table import Table


class PlannedSweep(NamedTuple):
    """A sweep that is needed before the calibration goes on."""

    test: Test
    rows: list[tuple[float, ...]]  #: values of the parameters
    seeds: range
    folder: Path


def check_targets(test: Test, runs: Table, keys: Sequence[str]) -> None:
    """Throws Error for a target that the runs do not measure."""
    there = [name for name in runs.names if "." in name and name not in keys]
    for target in test.targets:
        if target not in there:
            raise Error(f"{test.name}: no measure '{target}'; there are {', '.join(there)}{suggestion(target, there)}")


class TestMeans:
    """Means over the seeds of the targets of a test, at each point of its parameters."""

    def __init__(self, test: Test, keys: Sequence[str], folder: Path) -> None:
        sweep = Sweep(folder / test.name)
        runs = sweep.runs
        check_targets(test, runs, keys)
        self.values = {target: runs[target].astype(float) for target in test.targets}
        self.units = {target: sweep._measure(target.partition(".")[2]).unit for target in test.targets}
        rows = numpy.column_stack([runs[key].astype(float) for key in keys])
        self.points, self.point_of_run = numpy.unique(rows, axis=0, return_inverse=True)

    def means(self, target: str) -> tuple[Numbers, Numbers, Numbers]:
        """Points, means and variances of the means. The runs of a point scatter alike at all points."""
        there = numpy.isfinite(self.values[target])
        values, number = self.values[target][there], self.point_of_run[there]
        runs = numpy.bincount(number, minlength=len(self.points))
        some = runs > 0
        means = numpy.bincount(number, values, len(runs)) / numpy.maximum(runs, 1)
        scatter = ((values - means[number]) ** 2).sum() / max((runs[some] - 1).sum(), 1)
        return self.points[some], means[some], scatter / runs[some]


class Answer(NamedTuple):
    """What the rounds of a calibration have found."""

    study: Study
    posterior: Posterior
    surrogates: list[Surrogate]
    check: list[TestMeans]  #: of each test, at the most likely values
    runs: int


def scaled(study: Study, points: Numbers) -> Numbers:
    """Values of the parameters at points of the unit cube, with four digits of each range."""
    columns = []
    for (low, high), column in zip(study.vary.values(), points.T):
        digits = 4 - math.ceil(math.log10(high - low))
        columns.append(numpy.clip(numpy.round(low + (high - low) * column, digits), low, high))
    return numpy.column_stack(columns)


def step(study: Study, folder: Path, number: int) -> list[PlannedSweep] | Answer:
    """What to run next, from what is in the folder: step 0 is one run of each test, step 1 the first round, the last one but one
    the runs that check the answer. The same folder gives the same.
    """

    def planned(values: Numbers, seeds: range, part: str) -> list[PlannedSweep]:
        rows: list[tuple[float, ...]] = list(dict.fromkeys(map(tuple, values.tolist())))
        return [PlannedSweep(test, rows, seeds, folder / part / test.name) for test in study.tests]

    seeds, keys = range(1, study.seeds + 1), list(study.vary)
    first = scaled(study, sobol(len(keys), study.points, seed=1))
    if number == 0:  # so that a mistake is told before hundreds of runs
        return planned(first[:1], seeds[:1], "runs")
    if number == 1:
        for test in study.tests:
            if {*(runs := Sweep(folder / "runs" / test.name).runs)["status"]} == {"done"}:
                check_targets(test, runs, keys)
        return planned(first, seeds, "runs")
    design = [TestMeans(test, keys, folder / "runs") for test in study.tests]
    low, high = numpy.array(list(study.vary.values())).T
    surrogates = []
    for test, at in zip(study.tests, design):
        for target in test.targets:
            where, means, variances = at.means(target)
            if len(where) < study.points // 2:
                raise Error(f"{test.name}: {target} has a value at {len(where)} of {len(at.points)} points only")
            surrogates.append(Surrogate((where - low) / (high - low), means, variances))
    if all(surrogate.is_constant for surrogate in surrogates):
        named = ", ".join(f"{test.name}: {target}" for test in study.tests for target in test.targets)
        raise Error(f"no target depends on {' or '.join(keys)}: the same in all runs ({named})")
    found = posterior(surrogates, [value for test in study.tests for value in test.targets.values()], len(keys))
    if (drawn := number - 1) <= study.rounds:
        more = scaled(study, found.drawn(study.points // 2, drawn))
        return planned(numpy.vstack([design[0].points, more]), seeds, "runs")
    if drawn == study.rounds + 1:
        fresh = range(study.seeds + 1, study.seeds + study.check + 1)
        return planned(scaled(study, found.best()[None]), fresh, "check")
    check = [TestMeans(test, keys, folder / "check") for test in study.tests]
    return Answer(study, found, surrogates, check, sum(len(one.point_of_run) for one in design + check))
