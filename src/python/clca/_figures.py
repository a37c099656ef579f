"""Which figures the tables of a run, a gas or a sweep allow, and what is in them.

A new figure is one row of FIGURES, or a row with a function where it is special.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy
from matplotlib.collections import LineCollection  # type: ignore[import]
from matplotlib.colors import LinearSegmentedColormap  # type: ignore[import]
from numpy.typing import NDArray

from ._arguments import suggestion
from ._chart import THEORY_COLOR, Axis, Chart, Curve, Panel, running_mean
from ._error import Error
from ._folder import Run, Sweep
from ._table import TEXT_COLUMNS, Table, is_numeric

LABEL_CHARACTERS = frozenset("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_-+.")
NO_POINTS = numpy.empty(0)
ENOUGH_PAIRS = 100  # for a mean over them
Files = list[tuple[str, Table]]  # what `*` in the name stands for, and the table


class FigureChoice(NamedTuple):
    """What the user has chosen to be drawn, in place of all possible figures."""

    x: str = ""
    y: Sequence[str] = ()
    over: Sequence[str] = ()
    y2: str = ""  #: of a run: a column on a second axis
    log: str = ""  #: x, y or xy
    stages: Sequence[str] = ()
    first: float | None = None  #: of the time, or of the step where there is no time
    last: float | None = None
    filling: bool = True  #: also the stages that only fill the box
    mean: int = 1  #: over so many rows


class ChosenTables:
    """The chosen tables of a folder, with the chosen rows."""

    def __init__(self, folder: Run | Sweep, choice: FigureChoice) -> None:
        self.folder, self.choice, self.names = folder, choice, folder.tables
        self.title = folder.title or (folder.scene if isinstance(folder, Run) else folder.folder.name)
        if isinstance(folder, Run):
            self.stages = list(folder.stages)
        else:
            self.stages = list(dict.fromkeys(map(str, folder.measures["stage"]))) if "measures" in self.names else []
        for stage in choice.stages:
            if stage not in self.stages:
                near = suggestion(stage, self.stages) or f"; there are {', '.join(self.stages)}"
                raise Error(f"{folder.folder}: no stage '{stage}'{near}")
        self._tables: dict[str, Table] = {}

    def is_chosen_stage(self, stage: str) -> bool:
        known = self.folder.stages.get(stage) if isinstance(self.folder, Run) else None
        is_left_out = known is not None and known.fills and not self.choice.filling
        return not is_left_out and (not self.choice.stages or stage in self.choice.stages)

    def table(self, name: str) -> Table:
        if name not in self._tables:
            table, choice = self.folder.table(name), self.choice
            keep = numpy.ones(len(table), bool)
            if "stage" in table.names:
                keep &= numpy.array([self.is_chosen_stage(str(stage)) for stage in table["stage"]], bool)
            time = "time" if "time" in table.names else "step"
            if time in table.names and is_numeric(table[time]):
                if choice.first is not None:
                    keep &= table[time] >= choice.first
                if choice.last is not None:
                    keep &= table[time] <= choice.last
            self._tables[name] = table[keep]
        return self._tables[name]

    def files(self, pattern: str) -> Files:
        """Returns what `*` in the name stands for, in the order of stages or times, and the tables."""
        begin, star, _ = pattern.partition("*")
        if not star:
            return [("", self.table(pattern))] if pattern in self.names else []
        labels = [name[len(begin) :] for name in self.names if name.startswith(begin)]

        def order(label: str) -> tuple[int, float, str]:
            try:
                number = float(label)
            except ValueError:
                number = 0.0
            return (self.stages.index(label) if label in self.stages else len(self.stages), number, label)

        labels = sorted((label for label in labels if label and set(label) <= LABEL_CHARACTERS), key=order)
        return [(one, self.table(begin + one)) for one in labels if one not in self.stages or self.is_chosen_stage(one)]


def has_values(table: Table, column: str) -> bool:
    """Returns whether there is such a column with a value other than 0."""
    if column not in table.names:
        return False
    cells = table[column]
    return bool(numpy.any(numpy.isfinite(cells) & (cells != 0))) if is_numeric(cells) else len(cells) > 0


def time_column(table: Table) -> str:
    return next((name for name in ("time", "step", "cycle") if name in table.names), "")


def value_text(value: Any) -> str:
    return str(value) if isinstance(value, str) else f"{value:g}"


def groups_of(table: Table, column: str) -> list[tuple[str, Table]]:
    """Returns the rows of each value of a column; numbers ascend."""
    if column not in table.names:
        return [("", table)]
    cells = table[column]
    values = sorted(set(cells[numpy.isfinite(cells)])) if is_numeric(cells) else list(dict.fromkeys(cells))
    return [(value_text(value), table[cells == value]) for value in values]


def curve_of(source: ChosenTables, label: str, rows: Table, x: str, y: str, **more: Any) -> Curve:
    """Returns the curve of a column, with its standard error where there is one."""
    if source.choice.mean > 1:
        return Curve(label, rows[x], running_mean(rows[y], source.choice.mean), **more)
    if f"{y}_se" not in rows.names:
        return Curve(label, rows[x], rows[y], **more)
    return Curve(label, rows[x], rows[y], rows[y] - rows[f"{y}_se"], rows[y] + rows[f"{y}_se"], **more)


def legend_entry(label: str, line: str = "--") -> Curve:
    """Returns a curve without points, for a line in the legend."""
    return Curve(label, NO_POINTS, NO_POINTS, line=line, color=THEORY_COLOR)


class Figure(NamedTuple):
    """Content and table of a figure: a row of FIGURES, or a column that the user has chosen (`table` is empty)."""

    name: str
    table: str  #: `*` stands for a stage or a time
    y: str  #: a column; `.*` for each column KEY.NAME
    about: str
    rank: float = 0  #: what a report shows first has the highest
    x: str = ""  #: empty: time, or the step
    by: str = "stage"  #: a curve for each value of this column
    needs: tuple[str, ...] = ()  #: further columns
    zero: bool = False  #: the axis begins at 0
    top: float | None = None  #: where it ends
    log: bool = False
    style: str = "line"
    each: str = ""  #: a figure for each `file` or for each value of this column
    where: tuple[str, Any] = ("", None)  #: column, value: only rows with this text there, or with this number or a greater one
    draw: Callable[[ChosenTables, Figure, Files, str, Table], Panel] | None = None


def lines_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    """Returns curves of columns over time or another column."""
    x = figure.x or time_column(table)
    if figure.y.endswith("*"):
        prefix = figure.y[:-1]
        columns = [name for name in table.names if name.startswith(prefix) and has_values(table, name)]
        curves = [curve_of(source, column[len(prefix) :], table, x, column) for column in columns]
        label = table.label(columns[0]).replace(f", {columns[0][len(prefix):]}", "", 1)
    else:
        groups = groups_of(table, figure.by)
        curves = [curve_of(source, group, rows, x, figure.y, style=figure.style) for group, rows in groups]
        label = table.label(figure.y)
    return Panel(curves, Axis(table.label(x)), Axis(label, figure.log, figure.zero, high=figure.top), part)


def outflow_rate_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    """Returns the outflow rate, averaged over a twentieth of the time of outflow, at least three rows, or over the chosen rows."""
    units = source.folder.summary.get("units", {})
    name, mass = time_column(table), units.get("site_mass")
    time, left = table[name].astype(float), (mass or 1) * table[figure.y]
    while_leaving = time[(left > left[0]) & (left < left[-1])]
    row = float(numpy.ptp(time)) / max(len(numpy.unique(time)) - 1, 1)
    window = max(float(numpy.ptp(while_leaving if len(while_leaving) else time)) / 20, 3 * row)
    window = source.choice.mean * row if source.choice.mean > 1 else window
    begin, end = (time - window / 2).clip(time[0]), (time + window / 2).clip(max=time[-1])
    rate = (numpy.interp(end, time, left) - numpy.interp(begin, time, left)) / (end - begin).clip(1e-300)
    parts = [(stage, table["stage"] == stage) for stage in dict.fromkeys(table["stage"])]
    curves = [Curve(stage, time[rows], rate[rows]) for stage, rows in parts if numpy.ptp(left[rows]) > 0]
    unit = table.units[name] or name
    y = f"Outflow, mean over {window:.2g} {unit}{'s' * (unit == 'step')} ({'sites' if mass is None else 'kg'}/{unit})"
    return Panel(curves, Axis(table.label(name)), Axis(y, zero=True), part)


def profile_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    curves = [Curve(f"end of {label}", table["x"], table["height_end"]) for label, table in files]
    bed = numpy.concatenate([curve.x[curve.y > 0] for curve in curves])
    tall = 1.05 * max(float(numpy.nanmax(curve.y)) for curve in curves)
    margin = 0.03 * float(numpy.ptp(bed)) + 1
    x = Axis(table.label("x"), low=bed.min() - margin, high=bed.max() + margin)
    return Panel(curves, x, Axis(table.label("height_end"), low=0, high=tall), part, equal=True)


def slope_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    y = "repose_gravity_deg" if has_values(table, "repose_gravity_deg") else figure.y
    return lines_panel(source, figure._replace(y=y, style="points"), files, part, table)


def neighbours_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    fallen = table["fallen_d"]
    kept = Curve("neighbours kept", fallen, table["kept"], style="marked", color=0)
    apart = Curve("diffusion of pairs (right)", fallen, table["pair_diffusion"], style="marked", color=1)
    left, right = Axis(table.label("kept"), zero=True, high=1), Axis(table.label("pair_diffusion"), zero=True)
    return Panel([kept], Axis(table.label("fallen_d")), left, part, right, [apart])


def base_pressure_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    rules = [rule for rule in ("inner", "outer", "pair", "q", "contact") if has_values(table, f"pressure_{rule}")]
    curves = [Curve(rule, table["base_position"], table[f"pressure_{rule}"], style="marked") for rule in rules]
    x = Axis(table.label("base_position"), low=-1, high=1)
    return Panel(curves, x, Axis("Base pressure over its mean", zero=True), part)


def across_lines_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    """Returns profiles across lines: over x or y if all are level or upright."""
    groups = groups_of(table, "line")
    x = "position"
    for along, fixed in (("y", "x"), ("x", "y")):
        if all(numpy.ptp(rows[fixed]) < 1e-6 for _, rows in groups):
            x = along
    curves = [curve_of(source, group, rows, x, figure.y) for group, rows in groups]
    label = table.label(figure.y)
    if figure.y == "v_across":
        curves += [Curve("", rows[x], rows["v_along"], line="--", color=i) for i, (_, rows) in enumerate(groups)]
        curves += [legend_entry("across, to the right", "-"), legend_entry("along")]
        label = f"Velocity ({table.units['v_across']})"
    return Panel(curves, Axis(table.label(x)), Axis(label, zero=figure.zero, high=figure.top), part)


def plane_panel(draw: Callable[[Any], None], title: str, x: Sequence[float], y: Sequence[float], bar: bool = False) -> Panel:
    """Returns a panel with equal scales of x and y."""
    across, up = (Axis(f"{name} (spacings)", low=low, high=high) for name, (low, high) in (("x", x), ("y", y)))
    return Panel((), across, up, title, draw=draw, equal=True, bar=bar)


def cell_grid(table: Table) -> tuple[NDArray[Any], NDArray[Any], dict[str, NDArray[Any]], int]:
    """Returns centres of cells, and means over the windows of a stage; velocities and energy are weighted by particles."""
    xs, column = numpy.unique(table["x"].round(6), return_inverse=True)
    ys, row = numpy.unique(table["y"].round(6), return_inverse=True)
    windows, place, count = len(numpy.unique(table["step"])), row * len(xs) + column, len(xs) * len(ys)

    def total(cells: NDArray[Any]) -> NDArray[numpy.float64]:
        return numpy.asarray(numpy.bincount(place, numpy.nan_to_num(cells), count).reshape(len(ys), len(xs)), float)

    weight = total(table["particles"])
    with numpy.errstate(invalid="ignore", divide="ignore"):
        means = {name: total(table[name] * table["particles"]) / weight for name in ("vx", "vy", "fluctuation")}
    return xs, ys, means | {"packing": total(table["packing"]) / windows}, windows


def cell_spacing(*centres: NDArray[Any]) -> float:
    """Returns the least distance of the first `centres` that are two or more; else 1."""
    steps = [numpy.diff(numpy.unique(one)) for one in centres]
    return float(next((found[found > 1e-6].min() for found in steps if (found > 1e-6).any()), 1))


def draw_arrows(ax: Any, places: Sequence[Any], ends: Sequence[Any], cell: float, color: str) -> None:
    """Draws arrows of mean length 0.7 cells, none longer than 1.3, so that fast ones do not hide the others."""
    length = numpy.hypot(*ends)
    with numpy.errstate(invalid="ignore", divide="ignore"):
        scale = numpy.minimum(0.7 * cell / (float(numpy.nanmean(length)) or 1.0), 1.3 * cell / length)
    how = {"pivot": "mid", "angles": "xy", "scale_units": "xy", "scale": 1, "color": color, "width": 0.0025, "clip_on": False}
    ax.quiver(*places, *(end * scale for end in ends), **how).set_in_layout(False)


def field_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    xs, ys, means, windows = cell_grid(table)
    wide, tall = cell_spacing(xs, ys), cell_spacing(ys, xs)
    speeds = numpy.hypot(means["vx"], means["vy"])
    has_arrows = figure.y == "packing" and bool((speeds > 0).any())
    label = table.label(figure.y)
    if has_arrows:
        label = f"Packing; mean arrow: {numpy.nanmean(speeds):.2g} {table.units['vx']}"

    def draw(ax: Any) -> None:
        edges = [numpy.append(centres - size / 2, centres[-1] + size / 2) for centres, size in ((xs, wide), (ys, tall))]
        blue = LinearSegmentedColormap.from_list("blue", ["#ffffff", "#0072b2"])
        ax.grid(False)
        shown = ax.pcolormesh(*edges, means[figure.y], cmap=blue, vmin=0)
        ax.figure.colorbar(shown, ax=ax, shrink=0.9, aspect=25)
        if has_arrows:
            draw_arrows(ax, numpy.meshgrid(xs, ys), (means["vx"], means["vy"]), wide, "#202020")

    title = f"{part}, mean over {windows} window{'s' * (windows > 1)}\n{label}"
    return plane_panel(draw, title, (xs[0] - wide / 2, xs[-1] + wide / 2), (ys[0] - tall / 2, ys[-1] + tall / 2), bar=True)


def convection_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    cell = cell_spacing(table["x"])
    longest = float(numpy.nanmax(numpy.hypot(table["dx"], table["dy"])))

    def draw(ax: Any) -> None:
        draw_arrows(ax, (table["x"], table["y"]), (table["dx"], table["dy"]), cell, "#0072b2")

    limits = [(float(table[axis].min()) - cell, float(table[axis].max()) + cell) for axis in ("x", "y")]
    return plane_panel(draw, f"{part} (longest: {longest:.2g} spacings per cycle)", limits[0], limits[1])


def contacts_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    loads = source.table(f"loads-{part}")
    column = "normal_force" if has_values(table, "normal_force") else "sites"
    strongest = float(numpy.nanmax(table[column]))
    centres = {value_text(number): (x, y) for number, x, y in zip(loads["id"], loads["x"], loads["y"])}
    box = source.folder.summary.get("box", {})
    wide = box["right"] - box["left"] if box.get("periodic") else 0.0
    segments, widths = [], []
    for first, second, x, y, force in zip(*(table[name] for name in ("first", "second", "x", "y", column))):
        start, end = centres.get(value_text(first)), centres.get(value_text(second), (x, y))
        if start is None or not force > 0:
            continue
        those = [[start, end]]
        apart = end[0] - start[0]
        if wide and abs(apart) > wide / 2:  # the shorter way round: it ends at a side and goes on at the other
            turn = -math.copysign(wide, apart)
            those = [[start, (end[0] + turn, end[1])], [(start[0] - turn, start[1]), end]]
        segments += those
        widths += len(those) * [0.3 * math.ceil(10 * force / strongest)]

    def draw(ax: Any) -> None:
        ax.add_collection(LineCollection(segments, linewidths=widths, colors="#d55e00"))

    points = numpy.array(segments or [[(0, 0)]]).reshape(-1, 2)
    low, high = points.min(0) - 1, points.max(0) + 1
    x_limits = (box["left"], box["right"]) if wide else (low[0], high[0])
    return plane_panel(draw, f"{part} (widest: {strongest:.3g} {table.units[column]})", x_limits, (low[1], high[1]))


def bin_density(table: Table, share: str) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Returns lower ends of bins, densities and widths, to draw steps up to the last bin, which has no end."""
    width = table["upper"] - table["lower"]
    values = table[share] / width
    is_open = ~numpy.isfinite(width)
    values[1:][is_open[1:]] = values[:-1][is_open[1:]]
    return table["lower"], values, width


def fluctuation_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    curves = []
    names = {"share": "over the mean of the window", "share_local": "over the mean of the cell"}
    for column, name in (names | {"reference": "chi-square"}).items():
        x, y, _ = bin_density(table, column)
        curves.append(Curve(name, x, numpy.where(y > 0, y, numpy.nan), style="steps"))
    curves[-1] = curves[-1]._replace(line="--", color=THEORY_COLOR)
    return Panel(curves, Axis("X"), Axis("Probability density of X", log=True), part)


def forces_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    curves = []
    for label, table in files:
        middle = (table["low"] + table["high"]) / 2
        mean = float((middle * table["count"]).sum() / table["count"].sum())
        there = table["density"] > 0
        curves.append(Curve(label, middle[there] / mean, table["density"][there], style="marked"))
    return Panel(curves, Axis("f / mean f"), Axis("Probability density of f / mean f", log=True))


def theory_table(source: ChosenTables, *columns: str) -> Table | None:
    """Returns the closed forms, if they have values of all these columns."""
    table = source.table("closure") if "closure" in source.names else None
    return table if table is not None and all(has_values(table, column) for column in columns) else None


def gas_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    """Returns curves over time, one for each restitution, with error bars, and the closed forms dashed."""
    columns = figure.y.split("/")
    is_ratio = len(columns) > 1
    theory = theory_table(source, *columns)

    def curve(label: str, rows: Table, **more: Any) -> Curve:
        with numpy.errstate(invalid="ignore", divide="ignore"):
            values = rows[columns[0]] / rows[columns[1]] if is_ratio else rows[figure.y]
        return Curve(label, rows["time"], values, **more)

    groups = [(name, f"ε = {name}" if name else "simulation", rows) for name, rows in groups_of(table, "restitution")]
    if is_ratio:
        curves = [curve(label, rows) for _, label, rows in groups]
    else:
        curves = [curve_of(source, label, rows, "time", figure.y, style="sparse") for _, label, rows in groups]
    if theory is not None:
        numbers = {name: number for number, (name, _, _) in enumerate(groups)}
        shown = groups_of(theory, "restitution")
        curves += [curve("", rows, line="--", color=numbers.get(name, 0)) for name, rows in shown]
        curves.append(legend_entry("closed form"))
    floor = measure_value(source, "hellinger_floor")
    if figure.y.startswith("dh_") and floor > 0:
        ends = numpy.array([table["time"].min(), table["time"].max()])
        curves.append(Curve("chance", ends, numpy.full(2, floor), line=":", color=THEORY_COLOR))
    label = "T_rot / T_tr, relative to time 0" if is_ratio else table.label(figure.y)
    log = figure.log and not (has_values(table, "p_xy") and figure.y.startswith("t_"))
    return Panel(curves, Axis(table.label("time")), Axis(label, log), part)


def measure_value(source: ChosenTables, name: str) -> float:
    """Returns the measure in the last stage that has it; NaN where none has."""
    stages = source.folder.stages.values() if isinstance(source.folder, Run) else ()
    return float(next((one.measures[name] for one in reversed(list(stages)) if name in one.measures), math.nan))


def energy_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    """Returns distributions at the times of the histograms, and chi-square with three degrees of freedom."""
    curves, end = [], 0.0
    for label, table in files:
        x, y, width = bin_density(table, "share")
        end = max(end, float(numpy.nanmax(table["upper"])))
        shown = numpy.where(y > 0, y, 1e-12)  # in place of 0, which a logarithmic axis does not have
        error = table["share_se"] / width if "share_se" in table.names else numpy.nan
        curves.append(Curve(f"time {label}", x, shown, y - error, y + error, style="steps"))
    x = numpy.linspace(0, end, 400)[1:]
    curves.append(Curve("chi-square", x, numpy.sqrt(x / (2 * math.pi)) * numpy.exp(-x / 2), line="--", color=THEORY_COLOR))
    least = max(1e-4, min(float(curve.y[curve.y > 1e-12].min(initial=1)) for curve in curves) / 2)
    symbol = "ω" if "rotational" in figure.where else "v"
    y_axis = Axis("Probability density of X", log=True, low=least)
    return Panel(curves, Axis(f"X = |{symbol}|² / {symbol}₀²(t)", low=0, high=end), y_axis, f"ε = {part}" if part else "")


def stress_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    columns, theory = ["p_xx", "p_yy", "p_xy"], theory_table(source, "p_xy")
    curves = [curve_of(source, name.replace("_", " "), table, "time", name, style="sparse") for name in columns]
    if theory is not None:
        rows = dict(groups_of(theory, "restitution")).get(part, theory[:0])
        curves += [Curve("", rows["time"], rows[name], line="--", color=i) for i, name in enumerate(columns)]
        curves.append(legend_entry("theory, steady"))
    return Panel(curves, Axis(table.label("time")), Axis("Stress / mean pressure"), f"ε = {part}" if part else "")


def distribution_ratios_panel(source: ChosenTables, figure: Figure, files: Files, part: str, table: Table) -> Panel:
    curves = []
    names = {
        "automaton": "automaton, a temperature for all",
        "automaton_local": "automaton, one for each cell",
        "boltzmann_translational": "Boltzmann, translation",
        "boltzmann_rotational": "Boltzmann, rotation",
    }
    ends = numpy.append(table["quantile_lower"], table["quantile_upper"][-1])
    for column, name in names.items():
        if has_values(table, column):  # spheres that do not spin have no column of their own
            shares = table[column] / table["reference"]
            label = f"{name}: D_H = {measure_value(source, f'hellinger_{column}'):.1e}"
            curves.append(Curve(label, ends, numpy.append(shares, shares[-1]), style="steps"))
    curves.append(Curve("chi-square", numpy.array([0.0, 1.0]), numpy.ones(2), line="--", color=THEORY_COLOR))
    x = Axis("Quantile of chi-square: 2 degrees of freedom in the plane, 3 in space", low=0, high=1)
    return Panel(curves, x, Axis("Share / share under chi-square", zero=True))


# fmt: off
FIGURES = [
    Figure("profile", "profile-*", "height_end", "Surface of the bed above the floor of the box at the end of each stage; equal "
           "scales, so that slopes are seen as they are.", 9, "x", draw=profile_panel),
    Figure("motion", "series", "moving_share", "Share of the particles that move by a site in a step; by contact "
           "dynamics a slow one does so only now and then.", 5, zero=True, top=1),
    Figure("mean-height", "series", "mean_height", "Mean height of all particles above the floor of the box.", 4, zero=True),
    Figure("kinetic-energy", "series", "kinetic_energy", "Kinetic energy of all grains.", 6, zero=True),
    Figure("particles", "series", "particles", "Particles in the box, where some enter or leave.", zero=True),
    Figure("outflow", "series", "discharged_sites", "What has left through outlets; the slope is the outflow.", 8, zero=True),
    Figure("outflow-rate", "series", "discharged_sites", "Outflow: what leaves through outlets, a running mean over a twentieth of "
           "the time in which it leaves.", 7.5, draw=outflow_rate_panel),
    Figure("outflow-apart", "series", "discharged.*", "What has left through each outlet, and of each species.", 7, zero=True),
    Figure("probe-flow", "probes", "flow", "Flow through each probe, downwards.", 6, by="probe"),
    Figure("probe-filling", "probes", "filling", "Share of the sites of each probe that particles cover.", by="probe", zero=True,
           top=1),
    Figure("line-velocity", "lines-*", "v_across", "Mean velocity across and along each line of the scene over a stage, with bands "
           "of one standard error.", 7, by="line", each="file", draw=across_lines_panel),
    Figure("line-flux", "lines-*", "flux", "Flux to the right across each line of the scene over a stage, with bands of one "
           "standard error.", by="line", each="file", draw=across_lines_panel),
    Figure("line-filling", "lines-*", "filling", "Share of each line of the scene that particles cover, of what no wall covers; "
           "mean over a stage.", by="line", zero=True, top=1, each="file", draw=across_lines_panel),
    Figure("wall-travel", "series", "travel.*", "How far walls are from where they were at the beginning, along their motion."),
    Figure("wall-overlap", "series", "index.*", "Overlap that began at each wall: its index of force.", zero=True),
    Figure("segregation", "cycles", "segregation_index", "Segregation by cycle of shaking or turning: 0 mixed, 1 all large ones "
           "above all small ones.", 8, "cycle"),
    Figure("mixing", "cycles", "lacey_index", "Mixing by cycle of shaking or turning, Lacey’s index: 0 separated, 1 as mixed as by "
           "chance.", 8, "cycle"),
    Figure("intruder", "cycles", "intruder_height_rel", "Height of the intruder by cycle of shaking or turning.", 8, "cycle"),
    Figure("slope", "cycles", "repose_angle_deg", "Slope of the surface by cycle of shaking or turning; with a vessel against "
           "gravity.", 8, "cycle", draw=slope_panel),
    Figure("surface-height", "cycles", "height_mean", "Mean height of the surface above the floor of the box, by cycle.", 0,
           "cycle", zero=True),
    Figure("neighbours", "mixing-*", "kept", "Neighbours kept, and diffusion of pairs, against the distance that they have fallen.",
           7, "fallen_d", each="file", draw=neighbours_panel, where=("pairs", ENOUGH_PAIRS)),
    Figure("base-pressure", "weight_paths-*", "pressure_inner", "Pressure below a bed at rest, over its mean: of weight passed on "
           "by rules, and of the contact model.", 6, "base_position", each="file", draw=base_pressure_panel),
    Figure("convection", "convection-*", "dx", "Mean drift in a cycle of shaking or turning, as arrows: of mean length 0.7 times "
           "the width of a cell, and none longer than 1.3 times it, so that the fast ones at the surface do not hide the others.",
           7, "x", needs=("y", "dy"), each="file", draw=convection_panel),
    Figure("velocity-field", "fields", "packing", "Packing and mean velocity in the cells of a grid, over a stage.", 7, "x",
           needs=("y",), each="stage", draw=field_panel),
    Figure("fluctuation-field", "fields", "fluctuation", "Energy of the fluctuations in the cells of a grid, ½⟨|v - ⟨v⟩|²⟩, over a "
           "stage.", 0, "x", needs=("y",), each="stage", draw=field_panel),
    Figure("fluctuation", "fluctuation-*", "share", "Energy X of the fluctuations over its mean, and chi-square with 2 degrees of "
           "freedom.", 0, "lower", needs=("upper", "reference"), each="file", draw=fluctuation_panel),
    Figure("contacts", "contacts-*", "y", "Contacts at the end of a stage: lines between the centres of particles, or from them to "
           "a wall. The stronger, the wider: by normal force, or by the sites that both have.", 5, "x", each="file",
           draw=contacts_panel),
    Figure("forces", "forces-*", "density", "Distribution of the normal forces of the contacts, or by the automaton of the index "
           "of force, over their mean; at the end of a stage or averaged over it.", 6, "high", needs=("count",), draw=forces_panel),
    Figure("temperature-translational", "series", "t_tr", "Temperature of the translational motion, and its closed form.", 9,
           "time", log=True, draw=gas_panel),
    Figure("temperature-rotational", "series", "t_rot", "Temperature of the rotational motion, and its closed form.", 8, "time",
           log=True, draw=gas_panel),
    Figure("temperature-ratio", "series", "t_rot/t_tr", "Rotational temperature over the translational one, each relative to its "
           "beginning, and the closed form of it.", 7, "time", log=True, draw=gas_panel),
    Figure("distance-rotational", "series", "dh_rot", "How far the distribution of rotational energy is from chi-square: Figs. 3 "
           "(case 1) and 6 (case 2) of Ogawa & Kato 1982.", 6, "time", log=True, draw=gas_panel),
    Figure("distance-translational", "series", "dh_tr", "How far the distribution of translational energy is from chi-square.", 6,
           "time", log=True, draw=gas_panel),
    Figure("energy-rotational", "histogram-*", "share", "Distribution of the rotational energy at the times of the histograms, and "
           "chi-square with 3 degrees of freedom: Figs. 2 (case 1) and 5 (case 2) of Ogawa & Kato 1982.", 5, "upper",
           each="restitution", draw=energy_panel, where=("energy", "rotational")),
    Figure("energy-translational", "histogram-*", "share", "Distribution of the translational energy at the times of the "
           "histograms, and chi-square with 3 degrees of freedom: Fig. 4 (case 2) of Ogawa & Kato 1982.", 5, "upper",
           each="restitution", draw=energy_panel, where=("energy", "translational")),
    Figure("cumulant-translational", "series", "a2_tr", "Second cumulant of the translational motion: 0 for a normal distribution.",
           4, "time", draw=gas_panel),
    Figure("cumulant-rotational", "series", "a2_rot", "Second cumulant of the rotational motion: 0 for a normal distribution.", 4,
           "time", draw=gas_panel),
    Figure("correlation", "series", "correlation", "Correlation of translational and rotational energy.", 0, "time",
           draw=gas_panel),
    Figure("alignment", "series", "alignment", "Alignment of spins and velocities: 0 without a preferred angle.", 0, "time",
           draw=gas_panel),
    Figure("collisions", "series", "collisions", "Collisions in which a particle has taken part.", 0, "time", draw=gas_panel),
    Figure("stress", "series", "p_xy", "Pressure tensor of a sheared gas, and the theory of its steady state where a table has it.",
           8, "time", needs=("p_xx", "p_yy"), each="restitution", draw=stress_panel),
    Figure("comparison", "comparison", "automaton", "Energies of the particles of an automaton run beside those of a Boltzmann "
           "run: shares of bins that chi-square makes equally probable, over their share under chi-square.", 0, "quantile_upper",
           needs=("automaton_local", "boltzmann_translational", "reference"), draw=distribution_ratios_panel),
]
# fmt: on


def is_possible(figure: Figure, table: Table) -> bool:
    """Returns whether a table has the columns that the figure needs, with values."""
    if figure.y.endswith("*"):
        names = [name for name in table.names if name.startswith(figure.y[:-1]) and set(name) <= LABEL_CHARACTERS]
        return any(has_values(table, name) for name in names)
    if figure.name == "particles" and has_values(table, "particles"):
        return len(numpy.unique(table["particles"])) > 1
    return all(has_values(table, column) for column in (*figure.y.split("/"), figure.x, *figure.needs, figure.where[0]) if column)


def charts_of(source: ChosenTables, figure: Figure) -> list[Chart]:
    """Returns the charts of a figure; none if the tables lack something. Throws Error."""
    is_gas = figure.draw in (gas_panel, energy_panel, stress_panel)
    if isinstance(source.folder, Sweep) or is_gas != (source.folder.kind == "boltzmann"):
        return []
    files = [(label, table) for label, table in source.files(figure.table) if is_possible(figure, table)]
    for label, table in files:
        needed = {*figure.y.split("/"), figure.x, *figure.needs} & {*table.names} - TEXT_COLUMNS
        if not all(is_numeric(table[name]) for name in needed):
            source.folder.table(figure.table.replace("*", label))._check_numbers(*needed)
    if source.choice.y2:
        is_over_time = not figure.x and figure.draw in (None, outflow_rate_panel) and figure.by == "stage"
        is_over_time = is_over_time and not figure.y.endswith("*")
        files = [(label, table) for label, table in files if is_over_time and source.choice.y2 in table.names]
    if figure.name == "contacts":
        files = [(label, table) for label, table in files if f"loads-{label}" in source.names]
    parts: dict[str, Files] = {}
    column, value = figure.where
    for label, table in files:
        if column:
            cells = table[column]
            table = table[cells == value if isinstance(value, str) else cells >= value]
        for group, rows in groups_of(table, figure.each):
            if is_possible(figure, rows):
                parts.setdefault(label if figure.each == "file" else group, []).append((label, rows))
    return [chart_of(source, figure, those, part) for part, those in parts.items()]


def chart_of(source: ChosenTables, figure: Figure, files: Files, part: str = "") -> Chart:
    table, part_of = files[0][1], "Stage" if figure.each == "file" else figure.each
    name = f"{figure.name}-{part}" if part else figure.name
    about = f"{figure.about} {part_of}: {part}." if part else figure.about
    draw = partial(figure.draw or lines_panel, source, figure, files, part, table)

    def panels() -> list[Panel]:
        return [log_scaled(with_second_axis(source, figure, table, draw()), source.choice.log)]

    return Chart(name, about, figure.rank, panels, source.title, figure.name)


def with_second_axis(source: ChosenTables, figure: Figure, table: Table, panel: Panel) -> Panel:
    """Adds the column chosen for the second axis, dashed, for each group that has a curve."""
    if not (y2 := source.choice.y2):
        return panel
    table._check_numbers(y2)
    groups, left, right = dict(groups_of(table, figure.by)), f"{panel.y.label} (left)", f"{table.label(y2)} (right, dashed)"

    def dashed(of: Curve, label: str, color: int) -> Curve:
        return curve_of(source, label, groups[of.label], figure.x or time_column(table), y2, line="--", color=color)

    panel = panel._replace(y2=Axis(table.label(y2)))
    if len(panel.curves) == 1:  # its colour tells the axis
        (curve,) = panel.curves
        title = panel.title or curve.label
        return panel._replace(curves=[curve._replace(label=left, color=0)], on_y2=[dashed(curve, right, 1)], title=title)
    curves = [*panel.curves, legend_entry(left, "-"), legend_entry(right)]
    return panel._replace(curves=curves, on_y2=[dashed(curve, "", i) for i, curve in enumerate(panel.curves)])


def log_scaled(panel: Panel, log: str) -> Panel:
    for name in {*log}:
        cells = numpy.concatenate([NO_POINTS, *(getattr(curve, name) for curve in panel.curves)])
        if (cells <= 0).any() and (cells > 0).any() and not getattr(panel, name).words:
            warnings.warn(f"{panel.y.label}: points at 0 or below are not on the logarithmic axis {name}", stacklevel=2)
    x, y = (axis._replace(log=axis.log or name in log) for name, axis in (("x", panel.x), ("y", panel.y)))
    return panel._replace(x=x, y=y)


def column_chart(source: ChosenTables, y: str) -> Chart:
    """Returns the chart of a column that the user has chosen. Throws Error."""
    choice, where = source.choice, source.folder.folder
    if len(choice.over) > 1:
        over = " and ".join(choice.over)
        raise Error(f"{where}: of a run, a curve is drawn for each value of one column, not of {over}")
    table = table_with(source, [y, *filter(None, (choice.x, choice.y2, *choice.over))])
    x = choice.x or time_column(table)
    by = next((name for name in choice.over or ("line", "probe", "restitution", "stage") if name in table.names), "")
    if not x:
        raise Error(f"{where}: say which column is x")
    table._check_numbers(x, y, *filter(None, [choice.y2]))
    if not len(table):
        raise Error(f"{where}: '{y}' has no rows in the stages and times that are chosen")
    return chart_of(source, Figure(y, "", y, table.descriptions.get(y, y), x=x, by=by), [("", table)])


def table_with(source: ChosenTables, columns: list[str]) -> Table:
    """Returns the first table with all these columns: the series, else in alphabetical order. Throws Error."""
    known: list[str] = []
    tables = sorted(source.names, key=lambda name: (name != "series", name))
    for name in tables:
        table = source.table(name)
        if set(columns) <= set(table.names):
            return table
        known += table.names
    missing = next((column for column in columns if column not in known), None)
    if missing is not None:
        there = f"; {tables[0]}.csv has {', '.join(source.table(tables[0]).names)}" if tables else ""
        raise Error(f"{source.folder.folder}: no table with a column '{missing}'{suggestion(missing, known) or there}")
    raise Error(f"{source.folder.folder}: no table with all of the columns {', '.join(columns)}")


def charts(
    folder: Run | Sweep, choice: FigureChoice = FigureChoice(), unreadable: Callable[[Error], None] | None = None
) -> list[Chart]:
    """Returns all possible charts, or the chosen ones. Throws Error; if given, `unreadable` gets errors of tables instead."""
    from ._sweep_figures import sweep_charts

    if choice.first is not None and choice.last is not None and choice.first > choice.last:
        raise Error(f"the last time {choice.last:g} is before the first, {choice.first:g}")
    source = ChosenTables(folder, choice)
    if choice.y2 and isinstance(folder, Sweep):
        raise Error(f"{folder.folder}: figures of a sweep have no second axis")
    if isinstance(folder, Sweep):
        makers: list[Callable[[], list[Chart]]] = [partial(sweep_charts, source, folder)]
    elif choice.y:
        return [column_chart(source, y) for y in choice.y]
    elif choice.x or choice.over or choice.log:
        raise Error(f"{folder.folder}: of a run, say which columns are y, too")
    else:
        makers = [partial(charts_of, source, figure) for figure in FIGURES]
    found: list[Chart] = []
    for make in makers:
        try:
            found += make()
        except Error as error:
            if unreadable is None:
                raise
            unreadable(error)
    if choice.y2 and not found and (alone := FigureChoice(y2=choice.y2)) != choice:
        charts(folder, alone)  # says so if it is nowhere
    elif choice.y2 and not found:
        raise Error(f"{folder.folder}: no figure over time of a table with a column '{choice.y2}'")
    return found


def chart_names(possible: Iterable[Chart]) -> set[str]:
    """Returns the names of charts, and of their figures."""
    return {name for chart in possible for name in (chart.name, chart.source)}


def chosen_charts(folder: Run | Sweep, only: Sequence[str], choice: FigureChoice) -> list[Chart]:
    """Returns the charts with these names, of charts or of figures. Throws Error."""
    possible = charts(folder, choice)
    is_of_columns = choice.x or choice.y or choice.over or choice.y2
    nothing = "nothing to draw of what is chosen" if is_of_columns else "no rows in the stages and times that are chosen"
    if not possible:
        there_is = charts(folder)
        raise Error(f"{folder.folder}: {nothing if there_is else 'no tables that a figure could be drawn from'}")
    known = chart_names(possible)
    rows = {row.name: row for row in FIGURES}
    for name in (one for one in only if one not in known):
        if name in chart_names(charts(folder)):
            if choice.y2 and not choice.y:
                over_time = ", ".join(chart.name for chart in possible)
                raise Error(f"{folder.folder}: the figure '{name}' has no second axis; figures over time have one: {over_time}")
            raise Error(f"{folder.folder}: the figure '{name}' has {nothing}")
        if row := rows.get(name):
            columns = ", ".join(filter(None, (row.x, row.y, *row.needs)))
            needs = f"which needs {row.table}.csv: {columns}"
            raise Error(f"{folder.folder}: the tables do not allow the figure '{name}', {needs}")
        there = ", ".join(chart.name for chart in possible)
        raise Error(f"{folder.folder}: no figure '{name}' (there are: {there})")
    return [chart for chart in possible if not only or chart.name in only or chart.source in only]
