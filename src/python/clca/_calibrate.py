"""Calibration: which values of parameters give measured values, by designed runs, surrogates and runs that check the answer."""

from __future__ import annotations

import base64
import csv
import io
import json
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy

from . import _answer
from ._arguments import absolute, plain, to_yaml, whole
from ._error import ArgumentError, Error
from ._folder import Sweep, read_json, write_file
from ._notebook import Progress
from ._surrogate import Likely, Numbers, Surrogate, likely, sobol
from ._table import Table, quantities, read_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import]

MOST_PARAMETERS = 6
DRAWN = 1000  # rows of likely.csv
FILES = ("calibration.json", "calibration.png", "likely.csv", "parameters.csv", "report.html", "targets.csv")
SURE = 0.95  # probability of an interval

Place = tuple[str | int, ...]  # in a study: keys and numbers of items
Refuse = Callable[[Place, str], Error]


class Test(NamedTuple):
    """A scene, and what has been measured of what it stands for."""

    name: str
    scene: Any
    set: dict[str, Any]
    targets: dict[str, tuple[float, float]]  #: by STAGE.MEASURE: value and standard deviation


class Study(NamedTuple):
    tests: list[Test]
    vary: dict[str, tuple[float, float]]  #: the range of each parameter
    seeds: int  #: of each point
    points: int  #: of the first round
    rounds: int  #: after the first, each with half as many points
    check: int  #: seeds of the runs at the answer


# The study


def study_of(said: Mapping[str, Any], refuse: Refuse) -> Study:
    """Checks what a file or a call says. Throws what `refuse` makes of a place and a text."""

    def mapping(place: Place, value: Any, what: str) -> Mapping[str, Any]:
        if not isinstance(value, Mapping) or not value or not all(isinstance(key, str) for key in value):
            raise refuse(place, f"expected a map of {what}")
        return value

    def known(place: Place, value: Mapping[str, Any], keys: Sequence[str], required: Sequence[str]) -> None:
        for key in value:
            if key not in keys:
                raise refuse((*place, key), f"unknown key '{key}'; there are {', '.join(keys)}")
        for key in required:
            if key not in value:
                raise refuse(place, f"'{key}' is missing")

    def two(place: Place, value: Any, what: str) -> tuple[float, float]:
        is_pair = isinstance(value, (list, tuple)) and len(value) == 2
        if not is_pair or not all(isinstance(one, (int, float)) and math.isfinite(one) for one in value):
            raise refuse(place, f"expected {what}, found '{plain(value)}'")
        return float(value[0]), float(value[1])

    def number(key: str, default: int, least: int, most: int) -> int:
        try:
            return whole(key, said.get(key, default), least, most)
        except ArgumentError as error:
            raise refuse((key,), str(error)) from None

    known((), said, ("tests", "vary", "seeds", "points", "rounds", "check"), ("tests", "vary"))
    vary = {}
    for key, value in mapping(("vary",), said["vary"], "parameters and their ranges").items():
        vary[key] = two(("vary", key), value, "the range [LOWEST, HIGHEST]")
        if vary[key][0] >= vary[key][1]:
            raise refuse(("vary", key), f"the range is empty: {vary[key][0]:g} to {vary[key][1]:g}")
    if len(vary) > MOST_PARAMETERS:
        raise refuse(("vary",), f"at most {MOST_PARAMETERS} parameters")
    if not isinstance(said["tests"], (list, tuple)) or not said["tests"]:
        raise refuse(("tests",), "expected a list of tests")
    tests: list[Test] = []
    for index, one in enumerate(said["tests"]):
        place: Place = ("tests", index)
        known(place, mapping(place, one, "scene and targets"), ("scene", "set", "targets"), ("scene", "targets"))
        scene = one["scene"]
        if isinstance(scene, (str, os.PathLike)) and not str(scene):
            raise refuse((*place, "scene"), "expected the name of a scene or its file")
        keys = mapping((*place, "set"), one["set"], "keys and values") if one.get("set") else {}
        for key in vary:
            if key in keys:
                raise refuse((*place, "set", key), f"'{key}' is varied")
        targets = {}
        for key, value in mapping((*place, "targets"), one["targets"], "measures and their values").items():
            where = (*place, "targets", key)
            if "." not in key:
                raise refuse(where, f"expected STAGE.MEASURE, found '{key}'")
            targets[key] = two(where, value, "[VALUE, STANDARD DEVIATION]")
            if targets[key][1] <= 0:
                raise refuse(where, "the standard deviation must be positive")
        name = Path(scene).stem if isinstance(scene, (str, os.PathLike)) else str(getattr(scene, "name", "scene"))
        same = [test.name for test in tests if test.name.split("~")[0] == name]
        set_of: dict[str, Any] = {"output": {}} | dict(keys)  # no pictures
        tests.append(Test(f"{name}~{len(same) + 1}" if same else name, scene, set_of, targets))
    points = number("points", 32, 8, 1024)
    if points & (points - 1):
        raise refuse(("points",), f"points: expected a power of two, found {points}")
    return Study(tests, vary, number("seeds", 8, 2, 1000), points, number("rounds", 2, 0, 20), number("check", 8, 2, 1000))


def read_study(file: Path) -> Study:
    """A study from a YAML file. Throws Error with file, line and column."""
    import yaml  # type: ignore[import]

    marks: dict[Place, Any] = {}

    def refuse(place: Place, text: str) -> Error:
        while place not in marks:
            place = place[:-1]
        return wrong(marks[place], text)

    def wrong(mark: Any, text: str) -> Error:
        return Error(f"{file}:{mark.line + 1}:{mark.column + 1}: error: {text}")

    def value_of(node: Any, place: Place) -> Any:
        marks.setdefault(place, node.start_mark)
        if isinstance(node, yaml.SequenceNode):
            return [value_of(one, (*place, number)) for number, one in enumerate(node.value)]
        if not isinstance(node, yaml.MappingNode):
            return loader.construct_object(node)
        found: dict[str, Any] = {}
        for key_node, one in node.value:
            key = loader.construct_object(key_node)
            if not isinstance(key, str) or key in found:
                raise wrong(key_node.start_mark, f"'{key}' stands twice" if isinstance(key, str) else "a key is no text")
            marks[(*place, key)] = key_node.start_mark
            found[key] = value_of(one, (*place, key))
        return found

    try:
        if file.stat().st_size > 1 << 20:
            raise Error(f"cannot read {file}: it is larger than 1 MiB")
        text = file.read_text("utf-8")
        if any(isinstance(event, yaml.AliasEvent) for event in yaml.parse(text)):
            raise Error(f"cannot read {file}: it has aliases (*)")
        loader = yaml.SafeLoader(text)
        node = loader.get_single_node()
        said = value_of(node, ()) if node else None
    except OSError as error:
        raise Error(f"cannot read {file}: {error.strerror}") from None
    except (UnicodeDecodeError, RecursionError, yaml.reader.ReaderError):
        raise Error(f"cannot read {file}: it is no YAML") from None
    except yaml.MarkedYAMLError as error:
        raise wrong(error.problem_mark or error.context_mark, str(error.problem)) from None
    if not isinstance(said, dict):
        raise Error(f"{file}:1:1: error: expected a map with tests and vary")
    study = study_of(said, refuse)
    for index, test in enumerate(study.tests):
        if not isinstance(test.scene, str):
            raise refuse(("tests", index, "scene"), "expected the name of a scene or its file")
    beside = [test._replace(scene=str(file.parent / str(test.scene))) for test in study.tests]
    return study._replace(tests=[there if Path(there.scene).is_file() else test for there, test in zip(beside, study.tests)])


# The runs


class Planned(NamedTuple):
    """A sweep that is needed before it goes on."""

    test: Test
    rows: list[tuple[float, ...]]  #: values of the parameters
    seeds: range
    folder: Path


class Measured:
    """Means of the targets at points, over the seeds."""

    def __init__(self, test: Test, keys: Sequence[str], sweep: Sweep) -> None:
        runs = sweep.runs
        names = runs.dtype.names or ()
        for target in test.targets:
            if target not in names:
                there = [name for name in names if "." in name and name not in keys]
                raise Error(f"{test.name}: no measure '{target}'; there are {', '.join(there)}")
        self.values = {target: numpy.asarray(runs[target], dtype=float) for target in test.targets}
        self.quantities = {target: sweep._measure(target.partition(".")[2]) for target in test.targets}
        rows = numpy.column_stack([numpy.asarray(runs[key], dtype=float) for key in keys])
        self.points, self.number = numpy.unique(rows, axis=0, return_inverse=True)

    def means(self, target: str) -> tuple[Numbers, Numbers, Numbers]:
        """Points, means and variances of the means. The runs of a point scatter alike at all points."""
        values, there = self.values[target], numpy.isfinite(self.values[target])
        runs = numpy.bincount(self.number[there], minlength=len(self.points))
        some = runs > 0
        sums = numpy.bincount(self.number[there], values[there], len(self.points))
        means = numpy.divide(sums, runs, where=some, out=numpy.zeros(len(runs)))
        squares = (values[there] - means[self.number[there]]) ** 2
        scatter = squares.sum() / max((runs[some] - 1).sum(), 1)
        return self.points[some], means[some], scatter / runs[some]


class Answer(NamedTuple):
    study: Study
    likely: Likely
    surrogates: list[Surrogate]
    check: list[Measured]  #: of each test, at the most likely values
    runs: int


def scaled(study: Study, points: Numbers) -> Numbers:
    """Values of the parameters at points of the unit cube, with four digits of each range."""
    columns = []
    for (low, high), column in zip(study.vary.values(), points.T):
        digits = 4 - math.ceil(math.log10(high - low))
        columns.append(numpy.clip(numpy.round(low + (high - low) * column, digits), low, high))
    return numpy.column_stack(columns)


def step(study: Study, folder: Path, number: int) -> list[Planned] | Answer:
    """What to run next, from what is in the folder: step 0 is the first round, the last one but one the runs that check
    the answer. The same folder gives the same.
    """
    if number == 0:
        return planned(study, folder, scaled(study, sobol(len(study.vary), study.points, seed=1)))
    keys = list(study.vary)
    design = [Measured(test, keys, Sweep(folder / "runs" / test.name)) for test in study.tests]
    bounds = numpy.array(list(study.vary.values()))
    surrogates = []
    for test, at in zip(study.tests, design):
        for target in test.targets:
            where, means, variances = at.means(target)
            if len(where) < study.points // 2:
                raise Error(f"{test.name}: {target} has a value at {len(where)} of {len(at.points)} points only")
            surrogates.append(Surrogate((where - bounds[:, 0]) / (bounds[:, 1] - bounds[:, 0]), means, variances))
    found = likely(surrogates, [value for test in study.tests for value in test.targets.values()], len(keys))
    if number <= study.rounds:
        return planned(study, folder, numpy.vstack([design[0].points, scaled(study, found.drawn(study.points // 2, number))]))
    if number == study.rounds + 1:
        best = [tuple(scaled(study, found.points[found.best()][None])[0].tolist())]
        seeds = range(study.seeds + 1, study.seeds + study.check + 1)
        return [Planned(test, best, seeds, folder / "check" / test.name) for test in study.tests]
    check = [Measured(test, keys, Sweep(folder / "check" / test.name)) for test in study.tests]
    return Answer(study, found, surrogates, check, sum(len(one.number) for one in design + check))


def planned(study: Study, folder: Path, values: Numbers) -> list[Planned]:
    rows: list[tuple[float, ...]] = list(dict.fromkeys(map(tuple, values.tolist())))
    return [Planned(test, rows, range(1, study.seeds + 1), folder / "runs" / test.name) for test in study.tests]


# The answer


def rank_correlations(points: Numbers) -> Numbers:
    """D x D, of the columns, from -1 to 1: also where one falls with the other along a curve."""
    found: Numbers = numpy.atleast_2d(numpy.corrcoef(points.argsort(0).argsort(0), rowvar=False))
    return found


def notes_of(
    answer: Answer, rows: Sequence[Mapping[str, Any]], targets: Sequence[Mapping[str, Any]], correlations: Numbers
) -> list[str]:
    """What has to be known beside the numbers."""
    notes = []
    study = answer.study
    least = numpy.abs(answer.likely.misfits).max(axis=1).min()
    if least > 2:
        notes.append(
            f"No values in these ranges give all targets: at the nearest, one is off by {least:.1f} standard deviations."
        )
    for row, (key, (low, high)) in zip(rows, study.vary.items()):
        if row["high"] - row["low"] > 0.5 * (high - low):
            notes.append(f"{key} is not determined: anything from {row['low']:.3g} to {row['high']:.3g} gives the targets.")
        elif row["low"] - low < 0.01 * (high - low) or high - row["high"] < 0.01 * (high - low):
            notes.append(f"{key} lies at the end of its range: a wider range may have better values.")
    keys = list(study.vary)
    for i, first in enumerate(keys):
        for j in range(i + 1, len(keys)):
            if abs(correlations[i, j]) > 0.8:
                sense = "less" if correlations[i, j] < 0 else "more"
                notes.append(
                    f"More of {first} with {sense} of {keys[j]} gives the same targets (correlation {correlations[i, j]:.2f}): "
                    "a further test that they change otherwise can tell them apart."
                )
    for row in targets:
        if abs(row["deviation"]) > 2.5:
            notes.append(
                f"{row['test']}: {row['target']} is {row['checked']:.4g} in the runs that check the answer, "
                f"{abs(row['deviation']):.1f} standard deviations from {row['value']:.4g}."
            )
    return notes


def tables_of(answer: Answer) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Rows of parameters.csv and of targets.csv."""
    study, found = answer.study, answer.likely
    low, high = (scaled(study, found.quantile(share)[None])[0] for share in ((1 - SURE) / 2, (1 + SURE) / 2))
    best, mean = (scaled(study, one[None])[0] for one in (found.points[found.best()], found.mean()))
    parameters = [
        {"parameter": key, "best": best[i], "mean": mean[i], "low": low[i], "high": high[i]}
        for i, key in enumerate(study.vary)
    ]
    targets = []
    surrogates = iter(answer.surrogates)
    for test, check in zip(study.tests, answer.check):
        for target, (value, error) in test.targets.items():
            predicted, own = (one[0] for one in next(surrogates)(found.points[found.best()][None]))
            _, means, variances = check.means(target)
            checked, standard_error = (means[0], math.sqrt(variances[0])) if len(means) else (math.nan, math.nan)
            targets.append(
                {
                    "test": test.name,
                    "target": target,
                    "unit": check.quantities[target].unit,
                    "value": value,
                    "standard_deviation": error,
                    "predicted": predicted,
                    "predicted_se": own,
                    "checked": checked,
                    "checked_se": standard_error,
                    "deviation": (checked - value) / math.hypot(error, standard_error),
                }
            )
    return parameters, targets


MEANINGS = {
    "parameters": {
        "parameter": ("Parameter", "its key in the scene"),
        "best": ("Most likely", "all parameters together"),
        "mean": ("Mean", "over all that is likely"),
        "low": ("Lower end", f"of the interval of {SURE:.0%}"),
        "high": ("Upper end", "of the same interval"),
    },
    "targets": {
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
    },
}


Rows = list[dict[str, Any]]


def content_of(answer: Answer) -> tuple[dict[str, Any], dict[str, Rows]]:
    """What is written about an answer: calibration.json, and the rows of each table."""
    study = answer.study
    parameters, targets = tables_of(answer)
    drawn = scaled(study, answer.likely.drawn(DRAWN, 0))
    correlations = rank_correlations(drawn)
    meanings = MEANINGS | {"likely": {key: (key, "equally likely values, a row each") for key in study.vary}}
    summary = {
        "tests": [
            {"name": test.name, "scene": scene_name(test), "set": plain(test.set), "targets": test.targets} for test in study.tests
        ],
        "vary": study.vary,
        **{key: getattr(study, key) for key in ("seeds", "points", "rounds", "check")},
        "runs": answer.runs,
        "correlations": correlations.tolist(),
        "notes": notes_of(answer, parameters, targets, correlations),
        "tables": {
            table: [{"key": key, "name": name, "meaning": meaning} for key, (name, meaning) in columns.items()]
            for table, columns in meanings.items()
        },
    }
    likely_rows = [dict(zip(study.vary, row)) for row in drawn.tolist()]
    return summary, {"parameters": parameters, "targets": targets, "likely": likely_rows}


def files_of(summary: dict[str, Any], tables: dict[str, Rows]) -> Iterator[tuple[str, bytes]]:
    """By name. The first one tells that it is the folder of a calibration."""
    yield "calibration.json", json.dumps(summary, indent=1, ensure_ascii=False).encode() + b"\n"
    for name, rows in tables.items():
        text = io.StringIO()
        writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
        yield f"{name}.csv", text.getvalue().encode()
    drawn = {key: numpy.array([row[key] for row in tables["likely"]]) for key in summary["vary"]}
    png = picture(summary["vary"], tables["parameters"], drawn)
    yield "calibration.png", png
    yield "report.html", page(summary, tables, png)


def scene_name(test: Test) -> str:
    return os.fspath(test.scene) if isinstance(test.scene, (str, os.PathLike)) else test.name


class Calibration:
    """What `calibrate` has found; also read again from its folder."""

    folder: Path
    summary: dict[str, Any]  #: what calibration.json says
    notes: list[str]  #: where the targets do not determine the parameters, or cannot be had
    keys: list[str]  #: the parameters
    correlations: Numbers  #: D x D, of the ranks of likely values, from -1 to 1

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = absolute(folder)
        self.summary = read_json(self.folder / "calibration.json")
        try:
            self.notes, self.keys = self.summary["notes"], list(self.summary["vary"])
            self.correlations = numpy.array(self.summary["correlations"], dtype=float)
        except (KeyError, TypeError, ValueError) as error:
            file = self.folder / "calibration.json"
            raise Error(f"cannot read {file}: {error} is missing or not what it should be") from None

    def __repr__(self) -> str:
        return "\n".join(summary_lines(self.parameters, self.targets, self.notes))

    def _table(self, name: str) -> Table:
        return read_table(self.folder / f"{name}.csv", quantities(self.summary["tables"][name]))

    @property
    def best(self) -> dict[str, float]:
        """The most likely value of each parameter, as `set` of `clca.run` takes them."""
        return {key: float(value) for key, value in zip(self.keys, self.parameters["best"])}

    @cached_property
    def parameters(self) -> Table:
        """A row for each parameter: `best`, `mean`, and `low`, `high` of the interval of 95 %."""
        return self._table("parameters")

    @cached_property
    def targets(self) -> Table:
        """A row for each target: measured, predicted by the surrogate, checked by fresh runs."""
        return self._table("targets")

    @cached_property
    def likely(self) -> Table:
        """Equally likely values of all parameters, a row each."""
        return self._table("likely")

    def plot(self) -> Figure:
        """What is likely: each parameter alone and each pair. A figure of pyplot, in the style that is set."""
        from matplotlib import pyplot  # type: ignore[import]

        count = len(self.keys)
        size = pyplot.rcParams["figure.figsize"][0] * max(count / 2, 0.6)
        figure = pyplot.figure(figsize=(size, size), layout="constrained")
        draw(figure, self.summary["vary"], self.parameters, self.likely)
        return figure


def summary_lines(parameters: Any, targets: Any, notes: Sequence[str]) -> list[str]:
    """The answer for a terminal, from rows of its tables."""
    lines = [f"{row['parameter']}: {row['best']:.4g}, likely {row['low']:.4g} to {row['high']:.4g}" for row in parameters]
    for row in targets:
        checked = f"{row['checked']:.4g} ± {row['checked_se']:.2g}"
        lines.append(f"{row['test']}: {row['target']} is {checked}, measured {row['value']:.4g} ± {row['standard_deviation']:.2g}")
    return [*lines, *notes]


def draw(figure: Any, vary: Mapping[str, Sequence[float]], parameters: Any, drawn: Any) -> None:
    """What is likely into a figure: parameters alone on the diagonal, pairs below it. `drawn`: values by parameter."""
    axes = figure.subplots(len(vary), len(vary), squeeze=False)
    for i, (key, row) in enumerate(zip(vary, parameters)):
        for j, (other, column) in enumerate(zip(vary, parameters)):
            ax = axes[i, j]
            if j > i:
                ax.remove()
                continue
            ax.set_xlim(vary[other])
            if i == j:
                ax.hist(drawn[key], bins=40, range=tuple(vary[key]), density=True)
                ax.axvspan(row["low"], row["high"], alpha=0.15, zorder=0)
                ax.axvline(row["best"], color="black")
                ax.set_ylabel("probability density")
            else:
                ax.scatter(drawn[other], drawn[key], s=4, alpha=0.4, linewidths=0)
                ax.plot(column["best"], row["best"], "k+", markersize=10)
                ax.set_ylim(vary[key])
                ax.set_ylabel(key)
            if i == len(vary) - 1:
                ax.set_xlabel(other)


def picture(vary: Mapping[str, Sequence[float]], parameters: Any, drawn: Any) -> bytes:
    from matplotlib.figure import Figure

    from ._chart import style

    out = io.BytesIO()
    with style(1):
        side = 1 + 2.2 * len(vary)
        figure = Figure(figsize=(side, side), layout="constrained")
        draw(figure, vary, parameters, drawn)
        figure.savefig(out, format="png", dpi=150, metadata={"Software": None})
    return out.getvalue()


def page(summary: dict[str, Any], tables: dict[str, Rows], png: bytes) -> bytes:
    from ._report import html

    shown: dict[str, Any] = {"picture": f"data:image/png;base64,{base64.b64encode(png).decode()}"}
    return html("calibration.html", {}, **(summary | tables | shown))


# What users call


def calibrate(
    scene: Any = None,
    targets: Mapping[str, tuple[float, float]] | None = None,
    vary: Mapping[str, tuple[float, float]] | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    tests: Sequence[Mapping[str, Any]] = (),
    seeds: int = 8,
    points: int = 32,
    rounds: int = 2,
    check: int = 8,
    output: str | os.PathLike[str] | None = None,
    jobs: int | None = None,
    progress: bool | Callable[[Progress], object] = False,
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
    from ._start import sweep

    if (scene is None) == (not tests):
        raise ArgumentError("calibrate: either a scene with targets, or tests")
    one = {"scene": scene, "targets": targets or {}, "set": set or {}}
    said = {"tests": list(tests) or [one], "vary": vary or {}, "seeds": seeds, "points": points, "rounds": rounds}

    def refuse(place: Place, text: str) -> Error:
        shown = place[2:] if not tests and place[:1] == ("tests",) else place
        return ArgumentError(": ".join(filter(None, (".".join(map(str, shown)), text))))

    study = study_of(said | {"check": check}, refuse)
    folder = absolute(output if output is not None else Path("renders") / f"{study.tests[0].name}-calibration")

    foreign = [name for name in FILES if (folder / name).exists()]
    if foreign and "calibration.json" not in foreign:
        raise Error(f"cannot write {folder / foreign[0]}: clca did not write the file that is there")
    following = step(study, folder, 0)
    for number in count(1):
        if isinstance(following, Answer):
            break
        for test, rows, numbers, there in following:
            sweep(test.scene, numbers, {tuple(study.vary): rows}, test.set, there, jobs, progress)
        following = step(study, folder, number)
    assert isinstance(following, Answer)
    for name, content in files_of(*content_of(following)):
        write_file(folder / name, content, is_listed=True)
    return Calibration(folder)


def command(options: dict[str, Any], folder_name: str) -> None:
    """One step: answers with the sweeps that are needed, or with the files of the answer."""
    study, folder = read_study(Path(options["study"])), Path(folder_name)
    following = step(study, folder, options["step"])
    if isinstance(following, Answer):
        summary, tables = content_of(following)
        for name, content in files_of(summary, tables):
            _answer.file(name, content)
        for text in summary_lines(tables["parameters"], tables["targets"], summary["notes"]):
            _answer.line(text)
        return
    separator = "," if len(study.vary) == 1 else "; "
    sweeps = [
        {
            "scene": test.scene,
            "set": [f"{key}={to_yaml(value)}" for key, value in test.set.items()],
            "vary": f"{','.join(study.vary)}={separator.join(','.join(map(repr, row)) for row in rows)}",
            "seeds": f"{seeds[0]}..{seeds[-1]}",
            "folder": os.fspath(there),
        }
        for test, rows, seeds, there in following
    ]
    _answer.file("sweeps.json", json.dumps(sweeps).encode())
