"""The rounds of a calibration: which runs are needed next, their results, and the answer that follows.

A Gaussian process for each measure interpolates it between the points that were run; from these and the measured values follows
how likely other parameters are. Points of the unit cube are N x D arrays.
"""

import math
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from ._arguments import suggestion
from ._error import Error
from ._folder import Sweep
from ._study import Study, CalibrationTest
from ._table import Table

Numbers = NDArray[numpy.float64]
SAMPLES = 2**13  # of the unit cube


class Surrogate:
    """Interpolates means of a measure over the seeds. `variances` are those of the means."""

    def __init__(self, points: Numbers, means: Numbers, variances: Numbers) -> None:
        from sklearn.exceptions import ConvergenceWarning  # type: ignore[import]
        from sklearn.gaussian_process import GaussianProcessRegressor  # type: ignore[import]
        from sklearn.gaussian_process.kernels import RBF, ConstantKernel  # type: ignore[import]

        # All points have the same seeds, whose common deviation no number of points averages out.
        self.common = float(variances.mean())
        self._mean = means.mean()
        self.is_constant = bool(numpy.ptp(means) <= 1e-12 * numpy.abs(means).max())  #: it depends on no parameter
        if self.is_constant:
            return
        kernel = ConstantKernel(1, (0.01, 100)) * RBF(numpy.full(points.shape[1], 0.5), (0.05, 20))
        alpha = numpy.maximum(variances / means.std() / means.std(), 1e-8)  # in the scale to which it brings the means
        process = GaussianProcessRegressor(kernel, alpha=alpha, normalize_y=True, n_restarts_optimizer=2, random_state=0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # a measure may not depend on a parameter at all
            self._process: Any = process.fit(points, means)

    def __call__(self, points: Numbers) -> tuple[Numbers, Numbers]:
        """Returns means and their standard errors."""
        if self.is_constant:
            return numpy.full(len(points), self._mean), numpy.zeros(len(points))
        found: tuple[Numbers, Numbers] = self._process.predict(points, return_std=True)
        return found


def sobol_points(dimensions: int, count: int, seed: int) -> Numbers:
    """Returns points that fill the unit cube evenly. `count` is a power of two."""
    from scipy.stats import qmc  # type: ignore[import]

    return numpy.asarray(qmc.Sobol(dimensions, seed=seed).random(count))


class Posterior(NamedTuple):
    """Points of the unit cube, each with its probability."""

    points: Numbers
    weights: Numbers
    misfits: Numbers  #: for each point and target: from the target, in standard deviations of both together

    def best(self) -> Numbers:
        return numpy.asarray(self.points[self.weights.argmax()])

    def mean(self) -> Numbers:
        return numpy.asarray(self.weights @ self.points)

    def quantile(self, share: float) -> Numbers:
        found = []
        for column in self.points.T:
            order = column.argsort()
            rank = int(numpy.searchsorted(self.weights[order].cumsum(), share))
            found.append(column[order[min(rank, len(order) - 1)]])
        return numpy.array(found)

    def samples(self, count: int, seed: int) -> Numbers:
        """Returns at most `count` different points, drawn by their probability."""
        generator = numpy.random.default_rng(seed)
        count = min(count, int((self.weights > 0).sum()))
        return numpy.asarray(generator.choice(self.points, count, replace=False, p=self.weights))


def posterior(surrogates: Sequence[Surrogate], targets: Sequence[tuple[float, float]], dimensions: int) -> Posterior:
    """Returns the posterior for a uniform prior in the unit cube. `targets`: values with their standard
    deviations, taken as normal and independent.
    """
    low, high = numpy.zeros(dimensions), numpy.ones(dimensions)
    for _ in range(3):  # each time within the bounds of what was likely
        points = low + (high - low) * sobol_points(dimensions, SAMPLES, seed=0)
        logs, misfits = numpy.zeros(len(points)), numpy.empty((len(points), len(targets)))
        for number, (surrogate, (value, error)) in enumerate(zip(surrogates, targets)):
            mean, own = surrogate(points)
            variance = own**2 + surrogate.common + error**2
            misfits[:, number] = (mean - value) / numpy.sqrt(variance)
            logs -= (misfits[:, number] ** 2 + numpy.log(variance)) / 2
        weights = numpy.exp(logs - logs.max())
        near = points[weights > 1e-4]
        margin = 0.05 * (high - low)
        low, high = numpy.maximum(near.min(0) - margin, 0), numpy.minimum(near.max(0) + margin, 1)
    return Posterior(points, weights / weights.sum(), misfits)


class PlannedSweep(NamedTuple):
    """A sweep that is needed before the calibration goes on."""

    test: CalibrationTest
    rows: list[tuple[float, ...]]  #: values of the parameters
    seeds: range
    folder: Path


def check_targets(test: CalibrationTest, runs: Table, keys: Sequence[str]) -> None:
    """Throws Error for a target that the runs do not measure."""
    there = [name for name in runs.names if "." in name and name not in keys]
    for target in test.targets:
        if target not in there:
            raise Error(f"{test.name}: no measure '{target}'; there are {', '.join(there)}{suggestion(target, there)}")


class TargetMeans:
    """Means over the seeds of the targets of a test, at each point of its parameters."""

    def __init__(self, test: CalibrationTest, keys: Sequence[str], folder: Path) -> None:
        sweep = Sweep(folder / test.name)
        runs = sweep.runs
        check_targets(test, runs, keys)
        self.values = {target: runs[target].astype(float) for target in test.targets}
        self.units = {target: sweep._measure(target.partition(".")[2]).unit for target in test.targets}
        rows = numpy.column_stack([runs[key].astype(float) for key in keys])
        self.points, self.point_of_run = numpy.unique(rows, axis=0, return_inverse=True)

    def means(self, target: str) -> tuple[Numbers, Numbers, Numbers]:
        """Returns points, means and variances of the means. Runs are taken to scatter equally at all points."""
        there = numpy.isfinite(self.values[target])
        values, number = self.values[target][there], self.point_of_run[there]
        runs = numpy.bincount(number, minlength=len(self.points))
        some = runs > 0
        means = numpy.bincount(number, values, len(runs)) / numpy.maximum(runs, 1)
        scatter = ((values - means[number]) ** 2).sum() / max((runs[some] - 1).sum(), 1)
        return self.points[some], means[some], scatter / runs[some]


class Answer(NamedTuple):
    """The result of the rounds of a calibration."""

    study: Study
    posterior: Posterior
    surrogates: list[Surrogate]
    check: list[TargetMeans]  #: of each test, at the most likely values
    runs: int


def parameter_values(study: Study, points: Numbers) -> Numbers:
    """Returns parameter values at points of the unit cube, with four digits of each range."""
    columns = []
    for (low, high), column in zip(study.vary.values(), points.T):
        digits = 4 - math.ceil(math.log10(high - low))
        columns.append(numpy.clip(numpy.round(low + (high - low) * column, digits), low, high))
    return numpy.column_stack(columns)


def next_step(study: Study, folder: Path, number: int) -> list[PlannedSweep] | Answer:
    """Returns the sweeps to run next, from the folder: step 0 is one run of each test, step 1 the first round, the last but one
    the runs that check the answer. The same folder gives the same.
    """

    def planned(values: Numbers, seeds: range, part: str) -> list[PlannedSweep]:
        rows: list[tuple[float, ...]] = list(dict.fromkeys(map(tuple, values.tolist())))
        return [PlannedSweep(test, rows, seeds, folder / part / test.name) for test in study.tests]

    seeds, keys = range(1, study.seeds + 1), list(study.vary)
    first = parameter_values(study, sobol_points(len(keys), study.points, seed=1))
    if number == 0:  # so that a mistake is told before hundreds of runs
        return planned(first[:1], seeds[:1], "runs")
    if number == 1:
        for test in study.tests:
            if {*(runs := Sweep(folder / "runs" / test.name).runs)["status"]} == {"done"}:
                check_targets(test, runs, keys)
        return planned(first, seeds, "runs")
    design = [TargetMeans(test, keys, folder / "runs") for test in study.tests]
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
        more = parameter_values(study, found.samples(study.points // 2, drawn))
        return planned(numpy.vstack([design[0].points, more]), seeds, "runs")
    if drawn == study.rounds + 1:
        fresh = range(study.seeds + 1, study.seeds + study.check + 1)
        return planned(parameter_values(study, found.best()[None]), fresh, "check")
    check = [TargetMeans(test, keys, folder / "check") for test in study.tests]
    return Answer(study, found, surrogates, check, sum(len(one.point_of_run) for one in design + check))
