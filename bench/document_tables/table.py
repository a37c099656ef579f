"""A table of a document: its rows and columns say what is run and which number of the run is shown."""

import hashlib
import math
import pathlib
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Cell:
    """Of `count` values the mean and the standard deviation, and how a page says it. With a count of 1 the deviation is the error of the mean."""

    text: str = ""
    mean: float = math.nan
    deviation: float = 0.0
    count: int = 1


def is_number(value):
    return not (isinstance(value, float) and math.isnan(value))


def number(value, decimals):
    text = f"{value:,.{decimals}f}"
    return text if text.strip("-0.,") else text.lstrip("-")


def bare(values, decimals):
    """The mean alone; of yes and no how many are yes."""
    mean, count = statistics.fmean(values), len(values)
    if isinstance(values[0], bool):
        share = (sum(values) + 1) / (count + 2)  # of none or of all another sample may have some, or some not
        return Cell(f"{sum(values)} of {count}", mean, math.sqrt(share * (1 - share)), count)
    return Cell(number(mean, decimals), mean, statistics.stdev(map(float, values)) if count > 1 else 0.0, count)


def scattered(values, decimals):
    """Mean ± standard deviation, if values differ."""
    cell = bare(values, decimals)
    return estimate(cell.mean, cell.deviation, decimals, cell.count) if len(set(values)) > 1 and not isinstance(values[0], bool) else cell


def with_range(values, decimals):
    cell = scattered(values, decimals)
    return Cell(f"{cell.text} ({number(min(values), decimals)} to {number(max(values), decimals)})", cell.mean, cell.deviation, cell.count)


def robust(values, decimals):
    """Median and range where values scatter by more than a third of their mean. 1.25: of the error of a median over that of a mean."""
    cell, middle = scattered(values, decimals), statistics.median(values)
    if 3 * cell.deviation < cell.mean:
        return cell
    return Cell(f"{number(middle, decimals)} ({number(min(values), decimals)} to {number(max(values), decimals)})", middle, 1.25 * cell.deviation, len(values))


def standard_error(values, decimals):
    """Mean ± standard error; of yes and no how many are yes."""
    if isinstance(values[0], bool):
        return bare(values, decimals)
    return estimate(statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values)), decimals)


def until_clog(values, decimals):
    """Of numbers of grains that left and whether the orifice clogged then: all that left over the number of clogs, with the standard error of a mean
    of as many exponentially distributed numbers."""
    clogs = sum(clogged for _, clogged in values)
    if not clogs:
        return Cell()
    mean = sum(left for left, _ in values) / clogs
    return estimate(mean, mean / math.sqrt(clogs), decimals)


def estimate(value, error, decimals, count=1):
    return Cell(f"{number(value, decimals)} ± {number(error, decimals)}", value, error, count)


@dataclass
class Line:
    """A row or a column. What a row leaves out its column has, and then the table: keys of the scene to set, seeds, the function that takes numbers from
    a run, which of these is shown, with how many decimals; the scene, how a cell looks, what runs write, and what is
    set in runs of the same scene and these seeds whose ends the runs begin from."""

    title: str
    arguments: Sequence[str] = ()
    seeds: str | None = None
    source: Callable | None = None
    key: Hashable = None
    decimals: int | None = None
    scene: str | None = None
    style: Callable[[list, int], Cell] | None = None
    output: str | None = None
    begin: Sequence[str] | None = None


@dataclass
class Table:
    """`output` of its runs is as a scene has it, without pictures by default."""

    page: str
    name: str
    scene: str
    rows: list[Line]
    columns: list[Line]
    seeds: str = "101..104"
    source: Callable | None = None
    decimals: int = 2
    output: str = "{}"
    style: Callable[[list, int], Cell] = scattered
    begin: Sequence[str] = ()

    def cell(self, row, column, runs):
        key = self.what("key", row, column)
        values = [numbers[key] for numbers in self.measured(row, column, runs) if is_number(numbers.get(key, math.nan))]
        return self.what("style", row, column)(values, self.what("decimals", row, column)) if values else Cell()

    def measured(self, row, column, runs):
        """What the source takes from each run."""
        arguments = (f"output={self.what('output', row, column)}", *column.arguments, *row.arguments)
        return runs.taken(self.what("scene", row, column), self.what("seeds", row, column), arguments, self.what("source", row, column),
                          tuple(self.what("begin", row, column)))

    def what(self, name, *lines):
        return next(value for value in (getattr(line, name, None) for line in (*lines, self)) if value is not None)

    def count(self, row, column):
        """Of seeds."""
        first, last = self.what("seeds", row, column).split("..")
        return int(last) - int(first) + 1


@dataclass
class Fit:
    """A table of what needs several runs together: `made` returns its cells, row by row."""

    page: str
    name: str
    rows: list[Line]
    columns: list[Line]
    made: Callable[["Runs"], Iterable[list[Cell]]]

    def cell(self, row, column, runs):
        return runs.once(self.made)[self.rows.index(row)][self.columns.index(column)]

    def count(self, row, column):
        return 1  # estimate, with its error


class OutOfTime(Exception):
    pass


@dataclass
class Runs:
    """Sweeps by a program into a folder. Runs that are there are kept."""

    program: str
    folder: pathlib.Path
    jobs: int = 1
    until: float = math.inf  # of time.monotonic()
    made: dict = field(default_factory=dict)
    late: bool = False  # a sweep has been cut short

    def once(self, function):
        if function not in self.made:
            self.made[function] = list(function(self))
        return self.made[function]

    def taken(self, scene, seeds, arguments, source, begin=()):
        """What `source` takes from each run of a sweep; from those that there was time for, if two at least."""
        key = (scene, seeds, arguments, source, begin)
        if key not in self.made:
            folder = self.sweep(scene, seeds, arguments, begin)
            done = [run for run in map(opened, sorted(folder.glob("runs/*"), key=seed_of)) if run.status == "done"]
            if self.late and len(done) < 2:
                raise OutOfTime
            self.made[key] = [source(run) for run in done]
        return self.made[key]

    def sweep(self, scene, seeds, arguments, begin=()):
        """Its folder."""
        name = hashlib.sha1(repr((sorted(arguments), seeds, *begin)).encode()).hexdigest()[:10]
        folder = self.folder / f"{scene}-{name}"
        command = [self.program, "sweep", f"scenes/{scene}.yaml", "--quiet", "--jobs", str(self.jobs), "-o", str(folder)]
        if begin:
            ends = sorted((self.sweep(scene, seeds, begin) / "runs").resolve().iterdir())
            command += ["--seeds", "1", "--vary", f"begin.run={','.join(map(str, ends))}"]
        else:
            command += ["--seeds", seeds]
        for argument in arguments:
            command += ["--set", argument]
        left = self.until - time.monotonic()
        if left <= 0:
            raise OutOfTime
        try:
            subprocess.run(command, check=True, timeout=None if math.isinf(left) else left)
        except subprocess.TimeoutExpired:
            self.late = True
        except subprocess.CalledProcessError as failed:
            sys.exit(f"this sweep failed (exit code {failed.returncode}): {' '.join(command)}")
        return folder


def opened(folder):
    import clca  # not needed for titles of tables
    return clca.open(folder)


def seed_of(run):
    return int(run.name.split("=")[-1])
