"""Figures of a sweep: measures against what varies, and tables of means."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy

from ._arguments import suggestion
from ._chart import MOST_COLORS, Axis, Chart, Curve, Panel, running_mean
from ._error import Error
from ._figures import LABEL_CHARACTERS, FigureChoice, ChosenTables, has_values, log_scaled, value_text
from ._folder import Sweep
from ._table import Table, is_numeric, rows_of

MOST_PANELS = 16
MOST_LETTERS = 72  # of all words under an axis
DERIVED_RANK = 1e6  # of figures of measures that the scene derives: these come first
VESSEL_ANGLE = "vessel_angle_deg"
Combination = tuple[Any, ...]  # a value of each key


def sorted_values(cells: Any) -> list[Any]:
    """Returns the different values: numbers ascend, words keep their order."""
    return sorted(set(cells.tolist())) if is_numeric(cells) else list(dict.fromkeys(cells.tolist()))


def joined_texts(*parts: str) -> str:
    return ", ".join(filter(None, parts))


def label_of(keys: Sequence[str], cell: Combination) -> str:
    return ", ".join(f"{key}={value_text(value)}" for key, value in zip(keys, cell))


def rows_by_combination(rows: Table, keys: Sequence[str]) -> list[tuple[Combination, Table]]:
    """Returns the rows of each combination of values that occurs."""
    cells = rows_of(rows, keys)
    return [(cell, rows[numpy.array([one == cell for one in cells])]) for cell in dict.fromkeys(cells)]


class KeyRoles:
    """Which varied keys are on the axis, and which distinguish curves, panels and figures."""

    def __init__(self, sweep: Sweep, choice: FigureChoice, table: Table, along: Sequence[str]) -> None:
        others = [key for key in sweep.keys if key not in along]
        self.over = [key for key in choice.over if key in others] or ([] if choice.over else others)
        self.apart = [key for key in others if key not in self.over]
        self.values = {key: sorted_values(table[key]) for key in others}
        self.split: list[str] = []  # keys with a panel for each combination
        if len(self.over) > 1 and self.count(self.over) > MOST_COLORS:
            self.over, self.split = self.over[:1], self.over[1:]
            while self.count(self.split) > MOST_PANELS:
                self.apart.append(self.split.pop())

    def count(self, keys: Sequence[str]) -> int:
        return math.prod(len(self.values[key]) for key in keys)

    def combinations(self, rows: Table, keys: Sequence[str]) -> list[tuple[Combination, Table]]:
        """Returns rows_by_combination() in the order of the values."""
        places = [self.values[key] for key in keys]
        groups = rows_by_combination(rows, keys)
        return sorted(groups, key=lambda group: [place.index(value) for place, value in zip(places, group[0])])

    def label(self, cell: Combination) -> str:
        """Returns the label of a curve; the key is left out for a single word."""
        is_word = self.apart and len(cell) == 1 and isinstance(cell[0], str)
        return str(cell[0]) if is_word else label_of(self.over, cell)

    def panels(self, rows: Table, curve: Callable[[Table, str], Curve], x: Axis, y: Axis, title: str, log: str) -> list[Panel]:
        made: list[Panel] = []
        all_cells = [cell for cell, _ in self.combinations(rows, self.over)]
        has_scale = len(self.over) == 1 and len(all_cells) > MOST_COLORS and not isinstance(all_cells[0][0], str)
        for values, part in self.combinations(rows, self.split):
            lines = self.combinations(part, self.over)
            curves = [curve(those, self.label(cell)) for cell, those in lines]
            scale = (self.over[0], [cell[0] for cell, _ in lines]) if has_scale else None
            if len(all_cells) <= MOST_COLORS:
                curves = [one._replace(color=all_cells.index(cell)) for one, (cell, _) in zip(curves, lines)]
            name = joined_texts(title if not made else "", label_of(self.split, values))
            made.append(log_scaled(Panel(curves, x, y, name, scale=scale), log))
        return made


def sweep_charts(source: ChosenTables, sweep: Sweep) -> list[Chart]:
    """Returns the charts of a sweep. Throws Error, also if something chosen does not exist."""
    if "measures" not in source.names:
        return []
    table, keys, choice = source.table("measures"), sweep.keys, source.choice
    means = [name for name in source.names if name.startswith("mean-")]
    measures = list(dict.fromkeys(map(str, table["measure"])))
    averaged = {name.removesuffix("_se") for mean in means for name in source.table(mean).names if name.endswith("_se")}
    for chosen, what, shown, known in (
        ([choice.x] if choice.x else [], "varied key or measure", [*keys, *measures], {*keys, *measures}),
        (choice.y, "measure", measures, {*measures, *averaged, *map(".".join, rows_of(table, ("stage", "measure")))}),
        (choice.over, "varied key", keys, {*keys}),
    ):
        for name in chosen:
            if name not in known:
                raise Error(f"{sweep.folder / 'measures.csv'}: no {what} '{name}'{suggestion(name, shown)}")
    charts = measure_charts(source, sweep, table) if keys else []
    return charts + [chart for mean in means if not choice.x for chart in mean_charts(source, sweep, mean)]


def measure_charts(source: ChosenTables, sweep: Sweep, table: Table) -> list[Chart]:
    table._check_numbers("mean", "low", "high")
    choice, keys, of = source.choice, sweep.keys, sweep._measure
    is_key = not choice.x or choice.x in keys
    axis = choice.x if choice.x in keys else next((key for key in keys if key not in choice.over), keys[0])
    first = table[axis].tolist()
    along = [axis]
    for key in keys:
        second = table[key].tolist()
        vary_together = len(set(zip(first, second))) == len(set(first)) == len(set(second))
        along += [key] if key != axis and key not in choice.over and vary_together else []
    ways = KeyRoles(sweep, choice, table, along)
    words = [] if is_numeric(table[axis]) or not is_key else sorted_values(table[axis])
    most = max(MOST_LETTERS // max(len(words), 1), 4)
    shown_words = tuple(word if len(word) <= most else word[: most - 1] + "…" for word in words)
    x_name, derived = axis if is_key else choice.x, derived_of(sweep)
    x_axis = Axis(of(x_name).label() if not is_key or x_name in derived else x_name, words=shown_words)

    def of_row(row: Any) -> Combination:
        return (str(row["stage"]), *(row[key] for key in keys))

    turned = {of_row(row) for row in table[(table["measure"] == VESSEL_ANGLE) & (table["mean"] != 0)]}
    x_rows = {of_row(row): row for row in table[table["measure"] == x_name]}

    def curve(rows: Table, name: str) -> Curve:
        x, *ends = [numpy.array([words.index(value) for value in rows[axis]], float) if words else rows[axis]]
        if not is_key:
            against = [[x_rows[of_row(row)][column] for column in ("mean", "low", "high")] for row in rows]
            x, *ends = numpy.array(against, float).reshape(-1, 3).T
        rows = rows[order := numpy.argsort(x, kind="stable")]
        left, right = [numpy.where(numpy.isfinite(end), end, x)[order] for end in ends] or (None, None)
        return Curve(name, x[order], rows["mean"], rows["low"], rows["high"], left, right, style="bars")

    charts = []
    for stage, measure in dict.fromkeys(rows_of(table, ("stage", "measure"))):
        is_chosen = {measure, f"{stage}.{measure}"} & {*choice.y} if choice.y else measure != x_name
        if not is_chosen or not set(stage + measure) <= LABEL_CHARACTERS:
            continue
        rows = table[(table["stage"] == stage) & (table["measure"] == measure) & numpy.isfinite(table["mean"])]
        what = of(measure)
        left_out = turned if what.of_floor and not choice.y else set()
        places = list(map(of_row, rows))
        rows = rows[numpy.array([(is_key or place in x_rows) and place not in left_out for place in places], bool)]
        for number, (values, part) in enumerate(ways.combinations(rows, ways.apart), 1):
            seen = part["mean"] > 0 if "y" in choice.log else (part["mean"] != 0) | bool(choice.y)
            if not seen.any():
                continue
            log = choice.log + ("y" if measure.startswith("discharged_until_clog") else "")
            where = joined_texts(stage, label_of(ways.apart, values))
            about = what.about()
            about += f", against {x_axis.label}, at the end of stage {where}. "
            about += "Bars are one standard error over the seeds."
            name = f"sweep-{stage}-{measure}" + (f"-{number}" if ways.apart else "")
            rank = spread_in_errors(part) + (DERIVED_RANK if measure in derived else 0)
            panels = partial(ways.panels, part, curve, x_axis, Axis(what.label()), where, log)
            charts.append(Chart(name, about, rank, panels, source.title, "sweep"))
    return charts


def spread_in_errors(rows: Table) -> float:
    """Returns the spread of the means in units of their errors, to show large effects first."""
    means, errors = rows["mean"], numpy.nan_to_num((rows["high"] - rows["low"]) / 2)
    return float(numpy.ptp(means) / (errors.mean() + 0.01 * numpy.abs(means).max() + 1e-300))


def derived_of(sweep: Sweep) -> set[str]:
    """Returns the names of measures that the scene derives."""
    try:
        done = numpy.flatnonzero(sweep.runs["status"] == "done")
        return set(sweep[int(done[0])].summary.get("derived", {})) if len(done) else set()
    except Error:
        return set()


def mean_charts(source: ChosenTables, sweep: Sweep, name: str) -> list[Chart]:
    """Returns charts of means over the seeds: each column over time or position, with bands of one standard error."""
    table, choice = source.table(name), source.choice
    if "runs" not in table.names or not len(table):
        return []
    at = table.names.index("runs")
    heads, columns = table.names[len(sweep.keys) : at], table.names[at + 1 :: 2]
    groups = [head for head in heads if head in ("stage", "probe", "line")]
    positions = [head for head in heads if head not in groups]
    if not positions:
        return []
    table._check_numbers(*positions, *table.names[at + 1 :])
    x = "time" if "time" in positions and numpy.isfinite(table["time"]).all() else positions[0]
    x_axis = Axis(table.label(x) + (", since the stage began" if x in ("step", "time") else ""))
    ways = KeyRoles(sweep, choice, table, ())

    def curve(column: str, those: Table, label: str) -> Curve:
        error = numpy.nan_to_num(those[f"{column}_se"])
        means = running_mean(those[column], choice.mean) if choice.mean > 1 else those[column]
        style = "marked" if len(those) < 30 else "line"
        return Curve(label, those[x], means, means - error, means + error, style=style)

    charts = []
    for group, rows in rows_by_combination(table, groups):
        group_name = "-".join(group)
        for number, (values, part) in enumerate(ways.combinations(rows, ways.apart), 1):
            where = joined_texts(group_name or "-".join(name.split("-")[2:]), label_of(ways.apart, values))
            for column in columns:
                is_wanted = column in choice.y if choice.y else True
                if not is_wanted or not has_values(part, column) or not set(column + group_name) <= LABEL_CHARACTERS:
                    continue
                axis = x_axis
                if x in ("x", "position"):
                    there = part[x][numpy.isfinite(part[column]) & (part[column] != 0)]
                    if numpy.ptp(there) > 0:
                        axis = axis._replace(low=float(there.min()), high=float(there.max()))
                title = "-".join(filter(None, (name, group_name, column))) + (f"-{number}" if ways.apart else "")
                about = f"{table.descriptions[column]}, against {table.label(x)}: {where}. "
                about += "Means over the seeds; the band is one standard error to either side."
                panels = partial(ways.panels, part, partial(curve, column), axis, Axis(table.label(column)), where, choice.log)
                charts.append(Chart(title, about, 0.5, panels, source.title, "means"))
    return charts
