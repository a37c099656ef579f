"""Figures of a sweep: measures against what varies, and tables of means."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy

from ._chart import MOST_COLORS, Axis, Chart, Curve, Panel, running_mean
from ._error import Error
from ._figures import LABEL, Source, has, logged, suggestion, text_of, title_of
from ._table import Quantity, Table

MOST_PANELS = 16
MOST_WORDS = 72  # letters under an axis
FIRST = 1e6  # rank of what the scene itself derives
VESSEL_ANGLE = "vessel_angle_deg"


def in_order(cells: Any) -> list[Any]:
    """Numbers ascend, words as they appear."""
    return sorted(set(cells.tolist())) if cells.dtype.kind == "f" else list(dict.fromkeys(cells.tolist()))


def vary_together(table: Table, first: str, second: str) -> bool:
    pairs = set(zip(table[first].tolist(), table[second].tolist()))
    return len(pairs) == len(set(table[first].tolist())) == len(set(table[second].tolist()))


class Keys:
    """What of the keys that vary goes along the axis, tells curves, panels and figures apart."""

    def __init__(self, source: Source, table: Table, along: Sequence[str]) -> None:
        choice, keys = source.choice, source.folder.keys  # type: ignore[union-attr]
        self.table = table
        others = [key for key in keys if key not in along]
        self.over = [key for key in choice.over if key in others] or ([] if choice.over else others)
        self.apart = [key for key in others if key not in self.over]
        self.values = {key: in_order(table[key]) for key in others}
        self.split: list[str] = []  # keys with a panel for each combination
        count = math.prod(len(self.values[key]) for key in self.over)
        if count > MOST_COLORS and len(self.over) > 1:
            self.over, self.split = self.over[:1], self.over[1:]
            while math.prod(len(self.values[key]) for key in self.split) > MOST_PANELS:
                self.apart.append(self.split.pop())

    def label(self, keys: Sequence[str], values: Sequence[Any], bare: bool = False) -> str:
        is_word = bare and len(keys) == 1 and isinstance(values[0], str)
        return ", ".join(text_of(value) if is_word else f"{key}={text_of(value)}" for key, value in zip(keys, values))

    def combinations(self, rows: Table, keys: Sequence[str]) -> list[tuple[tuple[Any, ...], Table]]:
        """The rows of each combination of values that is there, in order."""
        if not keys:
            return [((), rows)]
        cells = list(zip(*(rows[key].tolist() for key in keys)))
        places = {cell: tuple(self.values[key].index(value) for key, value in zip(keys, cell)) for cell in set(cells)}
        found = []
        for cell in sorted(places, key=lambda cell: places[cell]):
            found.append((cell, rows[numpy.array([one == cell for one in cells])]))
        return found

    def scale(self, cells: Sequence[tuple[Any, ...]]) -> tuple[str, list[float]] | None:
        """Of a colour bar, where there are many numbers."""
        numbers = [cell[0] for cell in cells if len(cell) == 1 and isinstance(cell[0], float)]
        return (self.over[0], numbers) if len(numbers) == len(cells) > MOST_COLORS else None


def sweep_charts(source: Source) -> list[Chart]:
    """Throws Error, also for a choice of what is not there."""
    if "measures" not in source.names:
        return []
    table = source.table("measures")
    keys, choice = source.folder.keys, source.choice  # type: ignore[union-attr]
    means = [name for name in source.names if name.startswith("mean-")]
    averaged = {name for mean in means for name in source.table(mean).dtype.names or ()}
    measures = list(dict.fromkeys(map(str, table["measure"])))
    wrong = [
        (name, "varied key or measure", [*keys, *measures])
        for name in filter(None, [choice.x])
        if name not in keys and name not in measures
    ]
    wrong += [(name, "measure", measures) for name in choice.y if name not in measures and f"{name}_se" not in averaged]
    wrong += [(name, "varied key", list(keys)) for name in choice.over if name not in keys]
    for name, what, known in wrong:
        raise Error(f"{source.folder.folder / 'measures.csv'}: no {what} '{name}'{suggestion(name, known)}")
    charts = measure_charts(source, table) if keys else []
    if not choice.x:
        for mean in means:
            charts += mean_charts(source, mean)
    return charts


def measure_charts(source: Source, table: Table) -> list[Chart]:
    choice, keys = source.choice, list(source.folder.keys)  # type: ignore[union-attr]
    is_key = not choice.x or choice.x in keys
    axis = choice.x if choice.x in keys else next((key for key in keys if key not in choice.over), keys[0])
    along = [axis, *(key for key in keys if key != axis and key not in choice.over and vary_together(table, axis, key))]
    ways = Keys(source, table, along)
    words = [] if table[axis].dtype.kind == "f" or not is_key else in_order(table[axis])
    most = max(MOST_WORDS // max(len(words), 1), 4)
    shown_words = tuple(word if len(word) <= most else word[: most - 1] + "…" for word in words)
    of: Callable[[str], Quantity] = source.folder._measure  # type: ignore[union-attr]
    derived = derived_of(source)
    x_name = axis if is_key else choice.x

    x_label = of(x_name).label() if not is_key or x_name in derived else x_name
    turned = {row_key(row, keys) for row in table[(table["measure"] == VESSEL_ANGLE) & (table["mean"] != 0)]}
    x_rows = {row_key(row, keys): row for row in table[table["measure"] == choice.x]} if not is_key else {}

    def curve(rows: Table, name: str) -> Curve:
        x = rows[axis] if is_key and not words else None
        if words:
            x = numpy.array([words.index(value) for value in rows[axis]], float)
        left = right = None
        if not is_key:
            against = [x_rows[row_key(row, keys)] for row in rows]
            x, left, right = (
                numpy.array([row[column] for row in against], float) for column in ("mean", "low", "high")
            )
            left, right = numpy.where(numpy.isfinite(left), left, x), numpy.where(numpy.isfinite(right), right, x)
        order = numpy.argsort(x, kind="stable")
        low, high = rows["low"], rows["high"]
        if left is not None and right is not None:
            left, right = left[order], right[order]
        return Curve(
            name, numpy.asarray(x)[order], rows["mean"][order], low[order], high[order], left, right, style="bars"
        )

    charts = []
    for stage in dict.fromkeys(map(str, table["stage"])):
        for measure in dict.fromkeys(map(str, table["measure"][table["stage"] == stage])):
            wanted = measure in choice.y if choice.y else measure != x_name
            if not wanted or not set(stage + measure) <= LABEL:
                continue
            rows = table[(table["stage"] == stage) & (table["measure"] == measure) & numpy.isfinite(table["mean"])]
            if not choice.y and of(measure).of_floor:
                rows = rows[numpy.array([row_key(row, keys) not in turned for row in rows], bool)]
            if not is_key:
                rows = rows[numpy.array([row_key(row, keys) in x_rows for row in rows], bool)]
            parts = ways.combinations(rows, ways.apart)
            for number, (values, part) in enumerate(parts, 1):
                seen = part["mean"] > 0 if "y" in choice.log else (part["mean"] != 0) | bool(choice.y)
                if not len(part) or not seen.any():
                    continue
                log = choice.log + ("y" if measure.startswith("discharged_until_clog") else "")
                where = ", ".join(filter(None, (stage, ways.label(ways.apart, values))))
                what = of(measure)
                about = ", ".join(filter(None, (what.name, what.of))) + (
                    f": {what.description}" if what.description else ""
                )
                charts.append(
                    Chart(
                        f"sweep-{stage}-{measure}" + (f"-{number}" if ways.apart else ""),
                        f"{about}, against {x_label}, at the end of stage {where}. "
                        "Bars are one standard error over the seeds.",
                        contrast(part) + (FIRST if measure in derived else 0),
                        panels_of(
                            ways, part, curve, Axis(x_label, words=shown_words), Axis(of(measure).label()), where, log
                        ),
                        title_of(source.folder),
                        "sweep",
                    )
                )
    return charts


def row_key(row: Any, keys: Sequence[str]) -> tuple[Any, ...]:
    return (str(row["stage"]), *(row[key] for key in keys))


def contrast(rows: Table) -> float:
    """How far the means lie apart, in units of the errors: the larger, the more there is to see."""
    means, errors = rows["mean"], numpy.nan_to_num((rows["high"] - rows["low"]) / 2)
    return float(numpy.ptp(means) / (errors.mean() + 0.01 * numpy.abs(means).max() + 1e-300))


def derived_of(source: Source) -> set[str]:
    """Measures that the scene derives."""
    try:
        run = next(iter(numpy.flatnonzero(source.folder.runs["status"] == "done")), None)  # type: ignore[union-attr]
        return set() if run is None else set(source.folder[int(run)].summary.get("derived", {}))  # type: ignore[index]
    except Error:
        return set()


def panels_of(ways: Keys, rows: Table, curve: Any, x: Axis, y: Axis, title: str, log: str) -> Any:
    def panels() -> list[Panel]:
        made: list[Panel] = []
        all_cells = [cell for cell, _ in ways.combinations(rows, ways.over)]
        for values, part in ways.combinations(rows, ways.split):
            lines = ways.combinations(part, ways.over)
            scale = ways.scale(all_cells)
            shown = [curve(those, ways.label(ways.over, cell, bool(ways.apart))) for cell, those in lines]
            if scale is not None:
                places = {cell: number for number, cell in enumerate(all_cells)}
                scale = (scale[0], [scale[1][places[cell]] for cell, _ in lines])
            else:
                shown = (
                    [one._replace(color=all_cells.index(cell)) for one, (cell, _) in zip(shown, lines)]
                    if len(all_cells) <= MOST_COLORS
                    else shown
                )
            name = ", ".join(
                filter(None, (title if not made or not ways.split else "", ways.label(ways.split, values)))
            )
            made.append(logged(Panel(shown, x, y, name, scale=scale), log))
        return made

    return panels


def mean_charts(source: Source, name: str) -> list[Chart]:
    """Of a table of means over the seeds: each column over time or position, with bands of one standard error."""
    table, choice = source.table(name), source.choice
    keys = list(source.folder.keys)  # type: ignore[union-attr]
    names = list(table.dtype.names or ())
    if "runs" not in names or not len(table):
        return []
    heads = names[len(keys) : names.index("runs")]
    groups = [head for head in heads if head in ("stage", "probe", "line")]
    positions = [head for head in heads if head not in groups]
    x = "time" if "time" in positions and numpy.isfinite(table["time"]).all() else positions[0]
    ways = Keys(source, table, ())
    begin = "-".join(name.split("-")[:2])
    stage = name[len(begin) + 1 :]
    charts = []
    cells = list(zip(*(map(str, table[group]) for group in groups))) if groups else [()] * len(table)
    for group in dict.fromkeys(cells):
        rows = table[numpy.array([cell == group for cell in cells])]
        group_name = "-".join(group)
        for number, (values, part) in enumerate(ways.combinations(rows, ways.apart), 1):
            for column in names[names.index("runs") + 1 :: 2]:
                if (
                    (choice.y and column not in choice.y)
                    or not has(part, column)
                    or not set(column + group_name) <= LABEL
                ):
                    continue
                where = ", ".join(filter(None, (group_name or stage, ways.label(ways.apart, values))))
                ending = f"-{number}" if ways.apart else ""

                def curve(those: Table, label: str, column: str = column) -> Curve:
                    error = numpy.nan_to_num(those[f"{column}_se"])
                    means = running_mean(those[column], choice.mean) if choice.mean > 1 else those[column]
                    marked = "marked" if len(those) < 30 else "line"
                    return Curve(label, those[x], means, means - error, means + error, style=marked)

                x_label = table.label(x) + (", since the stage began" if x in ("step", "time") else "")
                axis = Axis(x_label)
                if x in ("x", "position"):
                    there = part[x][numpy.isfinite(part[column]) & (part[column] != 0)]
                    axis = (
                        Axis(x_label, low=float(there.min()), high=float(there.max())) if len(set(there)) > 1 else axis
                    )
                charts.append(
                    Chart(
                        "-".join(filter(None, (name, group_name, column))) + ending,
                        f"{table.descriptions[column]}, against {table.label(x)}: {where}. "
                        "Means over the seeds; the band is one "
                        "standard error to either side.",
                        0.5,
                        panels_of(ways, part, curve, axis, Axis(table.label(column)), where, choice.log),
                        title_of(source.folder),
                        "means",
                    )
                )
    return charts
