"""Measures as smooth functions of parameters, by Gaussian processes, and which parameters are likely, given measured values.

Parameters are N x D arrays of the unit cube.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

Numbers = NDArray[numpy.float64]
SAMPLES = 2**13  # of the unit cube


class Surrogate:
    """Means of a measure over the seeds, interpolated. `variances` are those of the means."""

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
        """Means and their standard errors."""
        if self.is_constant:
            return numpy.full(len(points), self._mean), numpy.zeros(len(points))
        found: tuple[Numbers, Numbers] = self._process.predict(points, return_std=True)
        return found


def sobol(dimensions: int, count: int, seed: int) -> Numbers:
    """Points that fill the unit cube evenly. `count` is a power of two."""
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

    def drawn(self, count: int, seed: int) -> Numbers:
        """So many different points or fewer, by their probability."""
        generator = numpy.random.default_rng(seed)
        count = min(count, int((self.weights > 0).sum()))
        return numpy.asarray(generator.choice(self.points, count, replace=False, p=self.weights))


def posterior(surrogates: Sequence[Surrogate], targets: Sequence[tuple[float, float]], dimensions: int) -> Posterior:
    """The posterior of parameters that are equally likely in the unit cube before. `targets`: values with their standard
    deviations, taken as normal and independent.
    """
    low, high = numpy.zeros(dimensions), numpy.ones(dimensions)
    for _ in range(3):  # each time within the bounds of what was likely
        points = low + (high - low) * sobol(dimensions, SAMPLES, seed=0)
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
