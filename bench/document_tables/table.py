"""A table of a document: its rows and columns say what is run and which number of the run is shown."""

import functools
import hashlib
import pathlib
import statistics
import subprocess
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass

import clca


@dataclass
class Line:
    """A row or a column. What a row leaves out its column has, and then the table: keys of the scene to set, seeds, the function that takes numbers from
    a run, and which of these is shown."""

    title: str
    arguments: Sequence[str] = ()
    seeds: str | None = None
    source: Callable[[clca.Run], Mapping[Hashable, float]] | None = None
    key: Hashable = None
    decimals: int | None = None


@dataclass
class Table:
    """`output` of its runs is as a scene has it, without pictures by default."""

    name: str
    scene: str
    rows: list[Line]
    columns: list[Line]
    seeds: str = "101..104"
    source: Callable[[clca.Run], Mapping[Hashable, float]] | None = None
    decimals: int = 2
    output: str = "{}"
    ranges: bool = False

    def write(self, program, folder):
        print(f"\n{self.name}\n\n| | {' | '.join(column.title for column in self.columns)} |")
        print("|" + "---|" * (len(self.columns) + 1), flush=True)
        for row in self.rows:
            print(f"| {row.title} | {' | '.join(self.cell(row, column, program, folder) for column in self.columns)} |", flush=True)

    def cell(self, row, column, program, folder):
        key = self.what("key", row, column)
        values = [numbers[key] for numbers in self.measured(row, column, program, folder) if key in numbers]
        return stated(values, self.what("decimals", row, column), self.ranges)

    def measured(self, row, column, program, folder):
        """What the source takes from each run."""
        arguments = (f"output={self.output}", *column.arguments, *row.arguments)
        return taken(program, folder, self.scene, self.what("seeds", row, column), arguments, self.what("source", row, column))

    def what(self, name, *lines):
        return next((value for value in (getattr(line, name, None) for line in (*lines, self)) if value is not None), None)


def sweep(program, scene, seeds, arguments, folder: pathlib.Path):
    """Runs that are there are kept."""
    command = [program, "sweep", f"scenes/{scene}.yaml", "--seeds", seeds, "--quiet", "-o", str(folder)]
    for argument in arguments:
        command += ["--set", argument]
    subprocess.run(command, check=True)


@functools.cache
def taken(program, folder, scene, seeds, arguments, source):
    """What `source` takes from each run of a sweep."""
    runs = folder / f"{scene}-{hashlib.sha1(repr((list(arguments), seeds)).encode()).hexdigest()[:10]}"
    sweep(program, scene, seeds, arguments, runs)
    return [source(clca.open(run)) for run in sorted((runs / "runs").iterdir())]


def stated(values, decimals, ranges=False):
    """Mean ± standard deviation; of yes and no how many are yes."""
    if not values:
        return ""
    if isinstance(values[0], bool):
        return f"{sum(values)} of {len(values)}"
    text = f"{statistics.mean(values):.{decimals}f}"
    if len(values) > 1:
        text += f" ± {statistics.stdev(values):.{decimals}f}"
    return text + (f" ({min(values):.{decimals}f} to {max(values):.{decimals}f})" if ranges else "")
