"""How figures look: curves, colours, legends, axes and pages, by matplotlib."""

from __future__ import annotations

import functools
import io
import math
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

INCH = 25.4  # mm
PAGE = 150 / INCH  # the width of a figure in pixels, as if printed: letters scale with it
LETTER = 8.0  # points
MOST_COLORS = 7  # of the palette; more take steps of a scale
# Okabe & Ito 2008: told apart by colour-blind people too.
PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
THEORY = "#404040"


Limits = tuple[float | None, float | None]


class Curve(NamedTuple):
    """Points that belong together, with what stands in the legend."""

    label: str
    x: NDArray[Any]
    y: NDArray[Any]
    low: NDArray[Any] | None = None  #: of the band or the error bars
    high: NDArray[Any] | None = None
    left: NDArray[Any] | None = None  #: of error bars along x
    right: NDArray[Any] | None = None
    line: str = "-"
    color: int | str | None = None  #: its number in the palette, or a colour; None: the next one
    style: str = "line"  #: or points, steps, bars


class Axis(NamedTuple):
    label: str = ""
    log: bool = False
    zero: bool = False  #: begins at 0
    low: float | None = None
    high: float | None = None
    words: Sequence[str] = ()  #: side by side at 0, 1, ...


class Panel(NamedTuple):
    """One pair of axes: curves, or what a function draws."""

    curves: Sequence[Curve] = ()
    x: Axis = Axis()
    y: Axis = Axis()
    title: str = ""
    y2: Axis | None = None
    on_y2: Sequence[Curve] = ()
    draw: Callable[[Any], None] | None = None
    equal: bool = False  #: scales of both axes
    scale: tuple[str, Sequence[float]] | None = None  #: label and numbers of a colour bar for the curves


class Chart(NamedTuple):
    """A figure: what is drawn once somebody asks for it."""

    name: str
    about: str
    rank: float
    panels: Callable[[], list[Panel]]
    title: str = ""  #: above it: that of the scene
    source: str = ""  #: name of the row that it comes from


@functools.lru_cache(maxsize=64)
def family_of(letters: str) -> tuple[str, ...]:
    """DejaVu Sans, and fonts of the system that have these letters."""
    from matplotlib import font_manager, ft2font  # type: ignore[import]

    there = [entry for entry in font_manager.fontManager.ttflist if entry.fname.endswith((".ttf", ".otf", ".ttc"))]
    for entry in there:
        try:
            if set(map(ord, letters)) <= set(ft2font.FT2Font(entry.fname).get_charmap()):
                return ("DejaVu Sans", entry.name)
        except RuntimeError:
            continue
    return ("DejaVu Sans",)


def plain(text: str) -> str:
    """As matplotlib shows it letter by letter; letters that no font has by their number."""
    from matplotlib import font_manager, ft2font, rcParams

    text = "".join(letter if letter.isprintable() or letter == "\n" else " " for letter in text)
    known = set(ft2font.FT2Font(font_manager.findfont("DejaVu Sans")).get_charmap())
    missing = "".join(sorted({letter for letter in text if letter != "\n" and ord(letter) not in known}))
    if missing:
        family = family_of(missing)
        if len(family) > 1:
            rcParams["font.family"] = list(family)
        else:
            text = "".join(f"[U+{ord(letter):04X}]" if letter in missing else letter for letter in text)
    return text.replace("$", r"\$")


def wrapped(text: str, inches: float, letter: float) -> str:
    """In lines that fit; before a unit first."""
    if "\n" in text:
        return "\n".join(wrapped(line, inches, letter) for line in text.split("\n"))
    most = max(int(inches * 72 / (0.6 * letter)), 8)
    head, mark, unit = text.rpartition(" (")
    parts = [head, mark[1:] + unit] if mark and len(text) > most else [text]
    return "\n".join(line for part in parts for line in textwrap.wrap(part, most) or [""])


def colors(count: int) -> list[Any]:
    """Of curves: those of the style, or, of many, steps from dark to light."""
    from matplotlib import cm, rcParams

    cycle = [entry["color"] for entry in rcParams["axes.prop_cycle"] if "color" in entry] or PALETTE
    if count <= max(len(cycle), 1):
        return cycle[:count]
    return [cm.viridis(0.92 * i / max(count - 1, 1)) for i in range(count)]


def running_mean(values: NDArray[Any], rows: int) -> NDArray[Any]:
    """Over so many rows around each, fewer at the ends; without those that have no value."""
    there = numpy.isfinite(values)
    sums = numpy.concatenate([[0], numpy.cumsum(numpy.where(there, values, 0))])
    counts = numpy.concatenate([[0], numpy.cumsum(there)])
    first = numpy.maximum(numpy.arange(len(values)) - (rows - 1) // 2, 0)
    last = numpy.minimum(numpy.arange(len(values)) + rows // 2 + 1, len(values))
    with numpy.errstate(invalid="ignore", divide="ignore"):
        means = (sums[last] - sums[first]) / (counts[last] - counts[first])
    return numpy.where(there, means, numpy.nan)


def draw_curve(ax: Any, curve: Curve, color: Any, log: bool) -> None:
    low, high = curve.low, curve.high
    with numpy.errstate(invalid="ignore"):
        if low is not None and log:  # a logarithmic axis cannot show a bar down to its end
            low = numpy.where(low > 0, low, curve.y)
    label = " " + curve.label if curve.label.startswith("_") else curve.label
    if curve.style == "steps":
        ax.plot(curve.x, curve.y, curve.line, color=color, label=label, drawstyle="steps-post")
    elif curve.style == "points":
        ax.plot(curve.x, curve.y, "o", color=color, label=label, markersize=2.5)
    elif curve.style == "bars":
        ax.plot(
            curve.x,
            curve.y,
            "o" + curve.line,
            color=color,
            label=label,
            markersize=4,
            linewidth=1.2,
            markerfacecolor=(*_rgb(color), 0.4),
        )
    else:
        few = "o" if curve.style == "marked" or numpy.count_nonzero(numpy.isfinite(curve.y)) == 1 else ""
        ax.plot(curve.x, curve.y, few + curve.line, color=color, label=label, markersize=2.5)
    if low is not None and high is not None and numpy.isfinite(low).any():
        if curve.style in ("bars", "steps") or curve.style == "sparse":
            every = max(1, len(curve.x) // 30)
            middle = curve.x
            if curve.style == "steps":
                middle = curve.x + 0.5 * numpy.append(numpy.diff(curve.x), 0)
            ax.errorbar(
                middle[::every],
                curve.y[::every],
                [(curve.y - low)[::every].clip(0), (high - curve.y)[::every].clip(0)],
                fmt="none",
                ecolor=color,
                elinewidth=0.8,
                capsize=1.5,
            )
        else:
            ax.fill_between(curve.x, low, high, color=color, alpha=0.25, linewidth=0)
    if curve.left is not None and curve.right is not None and numpy.any(curve.right > curve.left):
        ax.errorbar(
            curve.x,
            curve.y,
            xerr=[curve.x - curve.left, curve.right - curve.x],
            fmt="none",
            ecolor=color,
            elinewidth=0.8,
            capsize=1.5,
        )


def _rgb(color: Any) -> tuple[float, float, float]:
    from matplotlib.colors import to_rgb  # type: ignore[import]

    rgb: tuple[float, float, float] = to_rgb(color)
    return rgb


def draw_axis(ax: Any, which: str, axis: Axis, values: list[NDArray[Any]], given: Limits) -> None:
    """Scale, limits and ticks of `x` or `y`."""
    from matplotlib import ticker

    of = getattr(ax, f"{which}axis")
    set_limits = getattr(ax, f"set_{which}lim")
    flat = numpy.concatenate([numpy.asarray(part, float).ravel() for part in values]) if values else numpy.empty(0)
    flat = flat[numpy.isfinite(flat)]
    if axis.words:
        of.set_major_locator(ticker.FixedLocator(range(len(axis.words))))
        of.set_major_formatter(ticker.FixedFormatter([plain(word) for word in axis.words]))
        set_limits(-0.5, len(axis.words) - 0.5)
    elif axis.log and (flat > 0).any():
        getattr(ax, f"set_{which}scale")("log")
        flat = flat[flat > 0]
        if flat.max() / flat.min() < 300:
            of.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if flat.max() / flat.min() > 3 else range(1, 10)))
            of.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            of.set_minor_formatter(ticker.NullFormatter())
    elif which == "y" and len(flat):
        least, most = flat.min(), flat.max()
        pad = 0.05 * (most - least) or 0.1 * abs(most) or 1
        # From 0, unless that would leave most of the axis without points.
        is_from_zero = axis.zero or (least >= 0 and least < 0.5 * (most + pad))
        set_limits(min(0, least) if is_from_zero else least - pad, most + pad)
    limits = [axis.low if given[0] is None else given[0], axis.high if given[1] is None else given[1]]
    if limits != [None, None]:
        set_limits(*limits)


def draw_panel(
    ax: Any,
    panel: Panel,
    x_limits: Limits = (None, None),
    y_limits: Limits = (None, None),
    beside: Sequence[Panel] = (),
) -> None:
    """Into the axes of anybody, as a page does it. `beside`: panels that share the axes."""
    shown = [*panel.curves, *panel.on_y2]
    palette = colors(len([curve for curve in shown if curve.color is None]))
    if panel.scale is not None:
        from matplotlib import cm
        from matplotlib.colors import Normalize

        norm = Normalize(min(panel.scale[1]), max(panel.scale[1]))
        palette = [cm.viridis(0.92 * norm(number)) for number in panel.scale[1]]
    free = iter(palette)
    other = ax.twinx() if panel.y2 is not None else None
    for curve in shown:
        color = next(free) if curve.color is None else curve.color
        if isinstance(color, int):
            color = (palette or colors(MOST_COLORS))[color % len(palette or colors(MOST_COLORS))]
        on_other = other is not None and any(curve is one for one in panel.on_y2)
        draw_curve(other if on_other else ax, curve, color, (panel.y2 if on_other and panel.y2 else panel.y).log)
    if panel.draw is not None:
        panel.draw(ax)
    if panel.curves:
        all_curves = [curve for one in beside or [panel] for curve in one.curves]
        xs = [curve.x for curve in all_curves]
        ys = [part for curve in all_curves for part in (curve.y, curve.low, curve.high) if part is not None]
        draw_axis(ax, "x", panel.x, xs, x_limits)
        draw_axis(ax, "y", panel.y, ys, y_limits)
        if not (panel.x.words or panel.x.log) and x_limits == (None, None) and panel.x.low is None:
            ax.margins(x=0.03 if shown[0].style in ("bars", "points") else 0)
    elif panel.draw is not None:
        draw_axis(ax, "x", panel.x, [], x_limits)
        draw_axis(ax, "y", Axis(low=panel.y.low, high=panel.y.high), [], y_limits)
    if other is not None and panel.y2 is not None:
        draw_axis(other, "y", panel.y2, [curve.y for curve in panel.on_y2], (None, None))
    if panel.equal:
        ax.set_aspect("equal")
    labels(ax, panel, 1e9, 1e9, LETTER)
    ax.set_title(plain(panel.title), loc="left", fontsize="medium")


def labels(ax: Any, panel: Panel, wide: float, high: float, letter: float) -> None:
    """Of the axes, in lines that fit into so many inches."""
    ax.set_xlabel(wrapped(plain(panel.x.label), wide, letter))
    ax.set_ylabel(wrapped(plain(panel.y.label), high, letter))
    if panel.y2 is not None:
        for other in ax.figure.axes:
            if other is not ax and other.bbox.bounds == ax.bbox.bounds:
                other.set_ylabel(wrapped(plain(panel.y2.label), high, letter))


class Look(NamedTuple):
    """Of a file."""

    format: str = "png"
    in_mm: bool = False  #: width and height in millimetres, with letters of 8 points
    width: float = 960  #: pixels; 96 are an inch
    height: float | None = None  #: None: as the figure needs
    x_limits: Limits = (None, None)
    y_limits: Limits = (None, None)


@contextmanager
def style(scale: float) -> Iterator[None]:
    """Ours, but for what a style of the user has set."""
    import matplotlib

    ours: dict[str, Any] = {
        "font.size": LETTER * scale,
        "axes.labelsize": "medium",
        "axes.titlesize": "medium",
        "xtick.labelsize": "medium",
        "ytick.labelsize": "medium",
        "legend.fontsize": "medium",
        "figure.titlesize": "medium",
        "axes.prop_cycle": matplotlib.cycler(color=PALETTE),
        "axes.grid": True,
        "grid.color": "#dcdcdc",
        "grid.linewidth": 0.5 * scale,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.edgecolor": "#404040",
        "axes.linewidth": 0.6 * scale,
        "lines.linewidth": 1.2 * scale,
        "legend.frameon": False,
        "xtick.major.width": 0.6 * scale,
        "ytick.major.width": 0.6 * scale,
        "xtick.major.size": 2.5 * scale,
        "ytick.major.size": 2.5 * scale,
        "axes.titlepad": 3 * scale,
        "xtick.minor.size": 1.5 * scale,
        "ytick.minor.size": 1.5 * scale,
        "axes.labelpad": 2 * scale,
        "pdf.fonttype": 42,
        "svg.fonttype": "none",
        "svg.hashsalt": "clca",
    }
    default = matplotlib.rcParamsDefault
    with matplotlib.rc_context({key: value for key, value in ours.items() if matplotlib.rcParams[key] == default[key]}):
        yield


def rendered(chart: Chart, look: Look) -> bytes:
    """A whole file: the same for the same tables, matplotlib and fonts."""
    width = look.width / (INCH if look.in_mm else 96)
    scale = 1 if look.in_mm else width / PAGE
    height = None if look.height is None else look.height / (INCH if look.in_mm else 96)
    with style(scale):
        figure = page(chart, look, width, height, LETTER * scale)
        out = io.BytesIO()
        none = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}
        figure.savefig(out, format=look.format, dpi=300 if look.in_mm else 96, metadata=none[look.format])
        return out.getvalue()


def page(chart: Chart, look: Look, width: float, height: float | None, letter: float) -> Any:
    """The figure, with title, legend and panels, none of which covers another one."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # type: ignore[import]
    from matplotlib.figure import Figure  # type: ignore[import]

    panels = chart.panels()
    line = 1.3 * letter / 72
    columns = min(len(panels), max(1, int(width / (17 * letter / 72))), math.ceil(math.sqrt(len(panels))))
    rows = math.ceil(len(panels) / columns)
    wide = width / columns - 6 * line
    aspects = [aspect_of(panel) for panel in panels]
    each = max(min(aspect * wide, 1.2 * width) if aspect else 0.62 * width / columns for aspect in aspects)
    if columns == 1 and rows == 1 and not aspects[0]:
        each = (0.75 if look.in_mm else 0.625) * width - 4 * line
    room = max(each, 6 * line)
    figure = Figure(figsize=(width, height or 1), layout="constrained")
    canvas = FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.3 * line, h_pad=0.3 * line, wspace=0.02, hspace=0.02)
    axes = figure.subplots(rows, columns, squeeze=False, sharex=len(panels) > 1, sharey=len(panels) > 1).ravel()
    for ax in axes[len(panels) :]:
        ax.remove()
    for ax, panel in zip(axes, panels):
        draw_panel(ax, panel, look.x_limits, look.y_limits, panels)
    heads = [chart.title, panels[0].title if len(panels) == 1 else ""]
    title = wrapped(plain("\n".join(filter(None, heads))), width - 2 * line, letter)
    handles, names = legend_of(axes[: len(panels)], panels)
    legend, legend_rows = None, 0
    if len(names) > 1 or (names and names[0]):
        legend, legend_rows = legend_above(figure, canvas, handles, names, width - line)
    bar = next((panel.scale for panel in panels if panel.scale is not None), None)
    above = (title.count("\n") + 1 if title else 0) + legend_rows
    extra = rows * (3.5 + (1.4 if any(panel.title for panel in panels) else 0)) * line
    total = height or above * line + rows * room + extra
    figure.set_size_inches(width, total)
    is_tall = max(total - above * line, 4 * line) / rows - 3 * line
    for ax, panel in zip(axes, panels):
        labels(ax, panel, max(wide, 3 * line), max(is_tall, 3 * line), letter)
        name = wrapped(plain(panel.title), width / columns - 6 * line, letter) if len(panels) > 1 else ""
        ax.set_title(name, loc="left")
        if len(panels) > 1:
            ax.label_outer()
        tidy_ticks(ax, panel, wide, letter)
    if bar is not None:
        from matplotlib import cm
        from matplotlib.colors import LinearSegmentedColormap, Normalize

        colormap = LinearSegmentedColormap.from_list("clca", [cm.viridis(0.92 * i / 255) for i in range(256)])
        shown = cm.ScalarMappable(Normalize(min(bar[1]), max(bar[1])), colormap)
        figure.colorbar(shown, ax=list(axes[: len(panels)]), label=plain(bar[0]), aspect=30)
    share, margin = above * line / total, 0.3 * line  # equal scales are not quite what the layout has reckoned with
    figure.get_layout_engine().set(
        rect=(margin / width, margin / total, 1 - 2 * margin / width, 1 - share - 2 * margin / total)
    )
    if title:
        figure.text(0.5 * line / width, 1 - 0.25 * line / total, title, va="top", ha="left", linespacing=1.15)
    if legend is not None:
        legend.set_bbox_to_anchor((0.3 * line / width, 1 - (title.count("\n") + 1.1 if title else 0.1) * line / total))
    return figure


def aspect_of(panel: Panel) -> float | None:
    """Height over width, where both axes have one scale."""
    if not panel.equal:
        return None
    if None not in (panel.x.low, panel.x.high, panel.y.low, panel.y.high):
        return float((panel.y.high - panel.y.low) / (panel.x.high - panel.x.low))  # type: ignore[operator]
    return None


def legend_of(axes: Sequence[Any], panels: Sequence[Panel]) -> tuple[list[Any], list[str]]:
    """Each name once, over all panels."""
    if any(panel.scale is not None for panel in panels):
        return [], []
    found: dict[str, Any] = {}
    for ax in axes:
        for one in [ax] + [
            other for other in ax.figure.axes if other not in axes and other.bbox.bounds == ax.bbox.bounds
        ]:
            for handle, name in zip(*one.get_legend_handles_labels()):
                found.setdefault(plain(name), handle)
    return list(found.values()), list(found)


def legend_above(figure: Any, canvas: Any, handles: list[Any], names: list[str], room: float) -> tuple[Any, int]:
    """As many names side by side as fit; and how many lines that takes."""
    for columns in range(len(names), 0, -1):
        legend = figure.legend(
            handles,
            names,
            loc="upper left",
            ncol=columns,
            borderaxespad=0,
            borderpad=0,
            handlelength=1.6,
            columnspacing=1.2,
            labelspacing=0.25,
        )
        legend.set_in_layout(False)
        wide = legend.get_window_extent(canvas.get_renderer()).width / figure.dpi
        if wide <= room or columns == 1:
            return legend, math.ceil(len(names) / columns)
        legend.remove()
    raise AssertionError


def tidy_ticks(ax: Any, panel: Panel, wide: float, letter: float) -> None:
    """Words under an axis stand side by side, or aslant."""
    from matplotlib import ticker

    if panel.x.words:
        letters = sum(len(word) + 2 for word in panel.x.words)
        if letters * 0.6 * letter / 72 > wide:
            ax.tick_params(axis="x", labelrotation=30)
            for text in ax.get_xticklabels():
                text.set_ha("right")
    elif not panel.x.log:
        longest = 7 * 0.6 * letter / 72
        ax.xaxis.set_major_locator(ticker.MaxNLocator(max(2, min(9, int(wide / longest))), steps=[1, 2, 2.5, 5, 10]))
    if not panel.y.log and not panel.y.words and panel.equal:
        ax.yaxis.set_major_locator(ticker.MaxNLocator("auto", steps=[1, 2, 5, 10]))
