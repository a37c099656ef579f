"""Calibration finds values of parameters that reproduce measured values; this module writes and draws its result."""

from __future__ import annotations

import base64
import io
import json
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy

from . import _answer
from ._arguments import absolute_path, checked_mapping, plain_value, checked_progress as checked_progress, to_yaml, checked_workers
from ._error import ArgumentError, Error
from ._folder import Folder, make_clca_folder, refuse_other_kind, write_files
from ._notebook import Progress
from ._rounds import Answer, Numbers, parameter_values, next_step
from ._study import Place, read_study, parsed_study
from ._table import Quantity, Table, csv_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import]

DRAWN = 1000  # rows of likely.csv
SURE = 0.95  # probability of an interval
# Columns of tables: name and meaning.
PARAMETER_COLUMNS = {
    "parameter": ("Parameter", "its key in the scene"),
    "best": ("Most likely", "all parameters together"),
    "mean": ("Mean", "over all that is likely"),
    "low": ("Lower end", f"of the interval of {SURE:.0%}"),
    "high": ("Upper end", "of the same interval"),
}
TARGET_COLUMNS = {
    "test": ("Test", "its scene"),
    "target": ("Target", "a measure of a stage"),
    "unit": ("Unit", "of the measure"),
    "value": ("Measured", "the value that is looked for"),
    "standard_deviation": ("Standard deviation", "of the measured value"),
    "predicted": ("Predicted", "by the surrogate, at the most likely values"),
    "predicted_se": ("Standard error", "of the predicted value"),
    "checked": ("Checked", "mean of fresh runs at the most likely values"),
    "checked_se": ("Standard error", "of the checked value"),
    "deviation": ("Deviation", "of the checked from the measured value, in standard deviations of both together"),
}


class Calibration(Folder):
    """The result of `calibrate`, also read again from its folder."""

    notes: list[str]  #: where the targets do not determine the parameters, or cannot be had
    keys: list[str]  #: the parameters
    correlations: Numbers  #: D x D, of the ranks of likely values, from -1 to 1

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        super().__init__(folder, "calibration.json")
        self.notes, self.keys = self.summary["notes"], list(self.summary["vary"])
        rows = self.summary["correlations"]
        if {len(self.keys)} != {len(rows), *map(len, rows)}:
            raise Error(f"cannot read {self.folder / 'calibration.json'}: 'correlations' is not what it should be")
        self.correlations = numpy.array(rows, dtype=float)

    def __repr__(self) -> str:
        return "\n".join(summary_lines(self.parameters, self.targets, self.notes))

    @property
    def best(self) -> dict[str, float]:
        """The most likely value of each parameter, as `set` of `clca.run` takes them."""
        return dict(zip(self.keys, self.parameters["best"].tolist()))

    @cached_property
    def parameters(self) -> Table:
        """A row for each parameter: `best`, `mean`, and `low`, `high` of the interval of 95 %."""
        return self.table("parameters")

    @cached_property
    def targets(self) -> Table:
        """A row for each target: measured, predicted by the surrogate, checked by fresh runs."""
        return self.table("targets")

    @cached_property
    def likely(self) -> Table:
        """Equally likely values of all parameters, a row each."""
        return self.table("likely")

    def plot(self) -> Figure:
        """Draws the likely values of each parameter and of each pair. Returns a figure of pyplot in the style that is set."""
        from matplotlib import pyplot  # type: ignore[import]

        size = pyplot.rcParams["figure.figsize"][0] * max(len(self.keys) / 2, 0.6)
        figure = pyplot.figure(figsize=(size, size), layout="constrained")
        draw_posterior(figure, self.summary["vary"], self.parameters, self.likely)
        return figure


def tables_of(answer: Answer) -> dict[str, Table]:
    study, found = answer.study, answer.posterior
    points = numpy.array([found.best(), found.mean(), found.quantile((1 - SURE) / 2), found.quantile((1 + SURE) / 2)])
    rows, surrogates = [], iter(answer.surrogates)
    for test, check in zip(study.tests, answer.check):
        for target, (value, error) in test.targets.items():
            predicted, own = (one[0] for one in next(surrogates)(found.best()[None]))
            _, means, variances = check.means(target)
            checked, standard_error = (means[0], math.sqrt(variances[0])) if len(means) else (math.nan, math.nan)
            deviation = (checked - value) / math.hypot(error, standard_error)
            rows.append((test.name, target, check.units[target], value, error, predicted, own, checked, standard_error, deviation))
    likely = {key: (key, "equally likely values, a row each") for key in study.vary}

    def table(known: Mapping[str, tuple[str, str]], columns: Iterable[Any]) -> Table:
        named = zip(known.items(), columns)
        return Table((key, numpy.array(cells), Quantity(name, description=what)) for (key, (name, what)), cells in named)

    return {
        "parameters": table(PARAMETER_COLUMNS, [list(study.vary), *parameter_values(study, points)]),
        "targets": table(TARGET_COLUMNS, zip(*rows)),
        "likely": table(likely, parameter_values(study, found.samples(DRAWN, 0)).T),
    }


def notes_of(answer: Answer, tables: Mapping[str, Table], correlations: Numbers) -> Iterator[str]:
    """Yields warnings about the result."""
    vary = answer.study.vary
    least = numpy.abs(answer.posterior.misfits).max(axis=1).min()
    if least > 2:
        yield f"No values in these ranges give all targets: at the nearest, one is off by {least:.1f} standard deviations."
    for row, (key, (low, high)) in zip(tables["parameters"], vary.items()):
        if row["high"] - row["low"] > 0.5 * (high - low):
            yield f"{key} is not determined: anything from {row['low']:.3g} to {row['high']:.3g} gives the targets."
        elif row["low"] - low < 0.01 * (high - low) or high - row["high"] < 0.01 * (high - low):
            yield f"{key} lies at the end of its range: a wider range may have better values."
    for row, surrogate in zip(tables["targets"], answer.surrogates):
        if surrogate.is_constant:
            yield f"{row['test']}: {row['target']} does not depend on {' or '.join(vary)}: it is the same at all points."
    for (i, first), (j, second) in combinations(enumerate(vary), 2):
        if abs(together := correlations[i, j]) > 0.8:
            more = f"More of {first} with {'less' if together < 0 else 'more'} of {second} gives the same targets"
            yield f"{more} (correlation {together:.2f}): a further test that they change otherwise can tell them apart."
    for row in tables["targets"]:
        if abs(row["deviation"]) > 2.5:
            checked = f"{row['test']}: {row['target']} is {row['checked']:.4g} in the runs that check the answer"
            yield f"{checked}, {abs(row['deviation']):.1f} standard deviations from {row['value']:.4g}."


def summary_and_tables(answer: Answer) -> tuple[dict[str, Any], dict[str, Table]]:
    """Returns the content of calibration.json, and the tables."""
    study, tables = answer.study, tables_of(answer)
    points = numpy.array(tables["likely"].tolist())
    # Of ranks: also where one parameter falls with the other along a curve.
    correlations = numpy.atleast_2d(numpy.corrcoef(points.argsort(0).argsort(0), rowvar=False))
    tests = []
    for test in study.tests:
        scene = os.fspath(test.scene) if isinstance(test.scene, (str, os.PathLike)) else test.name
        tests.append({"name": test.name, "scene": scene, "set": plain_value("set", test.set), "targets": test.targets})
    summary = study._asdict() | {"tests": tests, "runs": answer.runs, "correlations": correlations.tolist()}
    summary |= {"notes": list(notes_of(answer, tables, correlations)), "tables": {}}
    for name, table in tables.items():
        known = table._quantities.items()
        summary["tables"][name] = [{"key": key, "name": what.name, "meaning": what.description} for key, what in known]
    return summary, tables


def files_of(summary: dict[str, Any], tables: dict[str, Table]) -> Iterator[tuple[str, bytes]]:
    """Yields name and content of each file. The first one marks the folder as one of a calibration."""
    from matplotlib.figure import Figure

    from ._chart import plot_style
    from ._report import rendered_html

    yield "calibration.json", json.dumps(summary, indent=1, ensure_ascii=False).encode() + b"\n"
    for name, table in tables.items():
        yield f"{name}.csv", csv_bytes(table.names, *table.tolist())
    png, side = io.BytesIO(), 1 + 2.2 * len(summary["vary"])
    with plot_style(1):
        figure = Figure(figsize=(side, side), layout="constrained")
        draw_posterior(figure, summary["vary"], tables["parameters"], tables["likely"])
        figure.savefig(png, format="png", dpi=150, metadata={"Software": None})
    yield "calibration.png", png.getvalue()
    picture = f"data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"
    yield "report.html", rendered_html("calibration.html", {}, **(summary | tables), picture=picture)


def summary_lines(parameters: Table, targets: Table, notes: Sequence[str]) -> list[str]:
    """Returns the lines that are printed, from rows of the tables."""
    lines = [f"{row['parameter']}: {row['best']:.4g}, likely {row['low']:.4g} to {row['high']:.4g}" for row in parameters]
    for row in targets:
        checked = f"{row['checked']:.4g} ± {row['checked_se']:.2g}"
        lines.append(f"{row['test']}: {row['target']} is {checked}, measured {row['value']:.4g} ± {row['standard_deviation']:.2g}")
    return [*lines, *notes]


def draw_posterior(figure: Any, vary: Mapping[str, Sequence[float]], parameters: Table, likely: Table) -> None:
    """Draws the likely values into a figure: single parameters on the diagonal, pairs below it."""
    axes = figure.subplots(len(vary), len(vary), squeeze=False)
    for i, (key, row) in enumerate(zip(vary, parameters)):
        for ax in axes[i, i + 1 :]:
            ax.remove()
        for ax, other, column in zip(axes[i, : i + 1], vary, parameters):
            if other == key:
                ax.hist(likely[key], bins=40, range=tuple(vary[key]), density=True)
                ax.axvspan(row["low"], row["high"], alpha=0.15, zorder=0)
                ax.axvline(row["best"], color="black")
                ax.set(xlim=vary[key], ylabel="probability density")
            else:
                ax.scatter(likely[other], likely[key], s=4, alpha=0.4, linewidths=0)
                ax.plot(column["best"], row["best"], "k+", markersize=10)
                ax.set(xlim=vary[other], ylim=vary[key], ylabel=key)
            if i == len(vary) - 1:
                ax.set_xlabel(other)


def calibrate(
    scene: Any = None, targets: Mapping[str, tuple[float, float]] | None = None,
    vary: Mapping[str, tuple[float, float]] | None = None, *, set: Mapping[str, Any] | None = None,
    tests: Sequence[Mapping[str, Any]] = (), seeds: int = 8, points: int = 32, rounds: int = 2, check: int = 8,
    output: str | os.PathLike[str] | None = None, jobs: int | None = None, progress: bool | Callable[[Progress], object] = False
) -> Calibration:
    """Finds values of parameters with which a scene gives what was measured, as `clca calibrate` does.

    `targets`: by `STAGE.MEASURE` the measured value and its standard deviation, in the unit of the measure. `vary`: the
    range of each parameter, a key of the scene. `scene` and `set` are as for `run`. Several tests with the same
    parameters are `tests`, each with `scene`, `targets` and `set`.

    A first round runs `points` points (a power of two) with `seeds` seeds each; each of `rounds` further rounds adds half as
    many where the answer may be; `check` seeds run at the answer. `output` is the folder, `renders/NAME-calibration`
    by default; runs that are there already are not run again. `jobs` and `progress` (of each round) are as for `sweep`.
    Throws Error. It needs SciPy and scikit-learn.
    """
    from ._scene import Scene, sweep

    is_alone = tests is None or isinstance(tests, (list, tuple)) and not tests
    if (scene is None) == is_alone:
        raise ArgumentError("calibrate: either a scene with targets, or tests")
    one = {"scene": scene, "targets": checked_mapping("targets", targets), "set": checked_mapping("set", set)}
    counts = {"seeds": seeds, "points": points, "rounds": rounds, "check": check}
    said = {"tests": [one] if is_alone else tests, "vary": checked_mapping("vary", vary)} | counts

    def refuse(place: Place, text: str) -> Error:
        shown = place[2:] if is_alone and place[:1] == ("tests",) else place
        return ArgumentError(": ".join(filter(None, (".".join(map(str, shown)), text))))

    study = parsed_study(said, refuse)
    checked_workers("jobs", jobs), checked_progress(progress)
    folder = absolute_path(output if output is not None else Path("renders") / f"{study.tests[0].name}-calibration")
    refuse_other_kind(folder, "calibration.json")
    for test in study.tests:  # before anything runs
        for ends in zip(*study.vary.values()):
            Scene.of(test.scene, set=test.set | dict(zip(study.vary, ends)))
    make_clca_folder(folder)
    number = 0
    while not isinstance(following := next_step(study, folder, number), Answer):
        for test, rows, numbers, there in following:
            sweep(test.scene, numbers, {tuple(study.vary): rows}, test.set, there, jobs, progress)
        number += 1
    write_files(folder, files_of(*summary_and_tables(following)))
    return Calibration(folder)


def command(options: dict[str, Any], folder: str) -> None:
    """Carries out one step. Answers with the needed sweeps, as options of `clca sweep`, or with the files of the result."""
    study = read_study(Path(options["study"]))
    refuse_other_kind(Path(folder), "calibration.json")
    following = next_step(study, Path(folder), options["step"])
    if isinstance(following, Answer):
        summary, tables = summary_and_tables(following)
        lines = summary_lines(tables["parameters"], tables["targets"], summary["notes"])
        _answer.send_files_and_lines(files_of(summary, tables), lines)
        return

    def varied(rows: Iterable[Sequence[float]]) -> str:
        return f"{','.join(study.vary)}={('; ' if len(study.vary) > 1 else ',').join(','.join(map(repr, row)) for row in rows)}"

    sweeps = [
        {
            "scene": test.scene,
            "set": [f"{key}={to_yaml(key, value)}" for key, value in test.set.items()],
            "vary": varied(rows),
            "ends": varied(zip(*study.vary.values())),
            "place": test.place,
            "seeds": f"{seeds[0]}..{seeds[-1]}",
            "folder": os.fspath(there),
        }
        for test, rows, seeds, there in following
    ]
    _answer.send_file("sweeps.json", json.dumps(sweeps).encode())
