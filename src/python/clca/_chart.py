"""How figures look: curves, colours, legends, axes and pages, by matplotlib."""

import functools
import io
import math
import re
import textwrap
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy
from matplotlib import cm, cycler, font_manager, ft2font, rc_context, rcParams, rcParamsDefault, ticker  # type: ignore[import]
from matplotlib.artist import setp  # type: ignore[import]
from matplotlib.backends.backend_agg import FigureCanvasAgg  # type: ignore[import]
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_rgba  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.lines import Line2D  # type: ignore[import]
from numpy.typing import NDArray

from ._error import Error

INCH = 25.4  # mm
PRINT_WIDTH = 150 / INCH  # inches: as wide as a figure is taken to be printed, whatever its pixels; letters scale with it
LETTER_SIZE = 8.0  # points
LEAST_LETTERS = 14  # of a line, so that few words have to be broken
MOST_COLORS = 7  # of the palette; more take steps of a scale
# Okabe & Ito 2008: told apart by colour-blind people too.
PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
THEORY_COLOR = "#404040"
COLOR_SCALE = LinearSegmentedColormap.from_list("clca", cm.viridis(numpy.linspace(0, 0.92, 256)))  # from dark to light

Limits = Sequence[float | None]


class Curve(NamedTuple):
    """The points of one curve, and its entry in the legend."""

    label: str
    x: NDArray[Any]
    y: NDArray[Any]
    low: NDArray[Any] | None = None  #: of the band or the error bars
    high: NDArray[Any] | None = None
    left: NDArray[Any] | None = None  #: of error bars along x
    right: NDArray[Any] | None = None
    line: str = "-"
    color: int | str | None = None  #: its number in the palette, or a colour; None: the next one
    style: str = "line"  #: or points, marked, steps, bars, sparse (bars at some points)


class Axis(NamedTuple):
    label: str = ""
    log: bool = False
    zero: bool = False  #: begins at 0
    low: float | None = None
    high: float | None = None
    words: Sequence[str] = ()  #: side by side at 0, 1, ...


class Panel(NamedTuple):
    """One pair of axes, with curves or the drawing of a function."""

    curves: Sequence[Curve] = ()
    x: Axis = Axis()
    y: Axis = Axis()
    title: str = ""
    y2: Axis | None = None
    on_y2: Sequence[Curve] = ()
    draw: Callable[[Any], None] | None = None
    equal: bool = False  #: scales of both axes
    bar: bool = False  #: `draw` makes a colour bar beside it
    scale: tuple[str, Sequence[float]] | None = None  #: label and numbers of a colour bar for the curves


class Chart(NamedTuple):
    """A figure, whose panels are made on demand."""

    name: str
    about: str
    rank: float
    panels: Callable[[], list[Panel]]
    title: str = ""  #: above it: that of the scene
    source: str = ""  #: name of the row of FIGURES, or of the column, that it comes from


@functools.lru_cache(maxsize=64)
def font_with(letters: str) -> str | None:
    """A font of the system that has these letters."""
    for entry in font_manager.fontManager.ttflist:
        try:
            if set(map(ord, letters)) <= set(ft2font.FT2Font(entry.fname).get_charmap()):
                return str(entry.name)
        except RuntimeError:
            continue
    return None


def plain_for_matplotlib(text: str) -> str:
    """Returns the text so that matplotlib shows it literally; letters that no font has become their code points."""
    text = "".join(letter if letter.isprintable() or letter == "\n" else " " for letter in text)
    known = ft2font.FT2Font(font_manager.findfont("DejaVu Sans")).get_charmap()
    missing = "".join(sorted({letter for letter in text if letter != "\n" and ord(letter) not in known}))
    font = font_with(missing) if missing else None
    if font:
        rcParams["font.family"] = ["DejaVu Sans", font]
    elif missing:
        text = "".join(f"[U+{ord(letter):04X}]" if letter in missing else letter for letter in text)
    return text.replace("$", r"\$")


def wrapped(text: str, inches: float, letter: float) -> str:
    """Breaks the text into lines that fit; a unit goes to the next line first."""
    if "\n" in text:
        return "\n".join(wrapped(line, inches, letter) for line in text.split("\n"))
    most = max(int(inches * 72 / (0.6 * letter)), LEAST_LETTERS)
    head, mark, unit = text.rpartition(" (")
    parts = [head, mark[1:] + unit] if mark and len(text) > most else [text]
    return "\n".join(line for part in parts for line in lines_of_length(part, most) or [""])


def lines_of_length(text: str, most: int) -> list[str]:
    """Breaks a text into lines of at most `most` letters: between words; long words behind `=`, `·`, `/` or dots if possible."""
    lines = []
    for line in textwrap.wrap(text, most, break_long_words=False):
        parts = re.sub(r"[=·/]|\.(?=[A-Za-z])", r"\g<0> ", line)
        lines += [line] if len(line) <= most else [part.replace(" ", "") for part in textwrap.wrap(parts, most)]
    return lines


def curve_colors(count: int) -> list[Any]:
    """Returns colours for curves: those of the style or, for many curves, steps from dark to light."""
    cycle = rcParams["axes.prop_cycle"].by_key().get("color", PALETTE)
    return [*cycle[:count]] if count <= len(cycle) else [*COLOR_SCALE(numpy.linspace(0, 1, count))]


def running_mean(values: NDArray[Any], rows: int) -> NDArray[Any]:
    """Returns the mean over `rows` rows around each, fewer at the ends; rows without a value are left out."""
    there, window = numpy.isfinite(values), numpy.ones(min(rows, 2 * len(values) + 2 - rows % 2))
    padded = (numpy.append(cells, 0) for cells in (numpy.where(there, values, 0), there))  # convolve() refuses nothing
    sums, counts = (numpy.convolve(cells, window)[len(window) // 2 :][: len(values)] for cells in padded)
    return numpy.where(there, sums / counts.clip(1), numpy.nan)


def draw_curve(ax: Any, curve: Curve, color: Any, log: bool) -> None:
    x, y, low, high, style = curve.x, curve.y, curve.low, curve.high, curve.style
    how = {"linestyle": "none" if style == "points" else curve.line, "markersize": 2.5}
    if style == "steps":
        how |= {"drawstyle": "steps-post"}
    elif style == "bars":
        how |= {"marker": "o", "markersize": 4, "linewidth": 1.2, "markerfacecolor": to_rgba(color, 0.4)}
    elif style in ("points", "marked") or numpy.isfinite(y).sum() == 1:
        how |= {"marker": "o"}
    label = " " + curve.label if curve.label.startswith("_") else curve.label
    ax.plot(x, y, color=color, label=label, **how)
    bars = {"fmt": "none", "ecolor": color, "elinewidth": 0.8, "capsize": 1.5}
    if low is not None and high is not None and numpy.isfinite(low).any():
        if log:  # a logarithmic axis cannot show a bar down to its end
            low = numpy.where(low > 0, low, y)
        if style in ("bars", "steps", "sparse"):
            some = slice(None, None, max(1, len(x) // 30))
            middle = x + 0.5 * numpy.append(numpy.diff(x), 0) if style == "steps" else x
            ax.errorbar(middle[some], y[some], [(y - low)[some].clip(0), (high - y)[some].clip(0)], **bars)
        else:
            ax.fill_between(x, low, high, color=color, alpha=0.25, linewidth=0)
    if curve.left is not None and curve.right is not None and numpy.any(curve.right > curve.left):
        ax.errorbar(x, y, xerr=[x - curve.left, curve.right - x], **bars)


def draw_axis(ax: Any, which: str, axis: Axis, values: list[NDArray[Any]], given: Limits = (None, None)) -> None:
    """Sets scale, limits and ticks of `x` or `y`."""
    of, set_limits = getattr(ax, f"{which}axis"), getattr(ax, f"set_{which}lim")
    flat = numpy.concatenate([numpy.asarray(part, float).ravel() for part in values]) if values else numpy.empty(0)
    flat = flat[numpy.isfinite(flat)]
    if axis.words:
        of.set_ticks(range(len(axis.words)), labels=[plain_for_matplotlib(word) for word in axis.words])
        set_limits(-0.5, len(axis.words) - 0.5)
    elif axis.log and (flat > 0).any():
        getattr(ax, f"set_{which}scale")("log", nonpositive="mask")
        flat = flat[flat > 0]
        if (ratio := flat.max() / flat.min()) < 300:
            of.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if ratio > 3 else range(1, 10)))
            of.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            of.set_minor_formatter(ticker.NullFormatter())
    elif which == "y" and len(flat):
        least, most = float(flat.min()), float(flat.max())  # which may overflow
        pad = 0.05 * (most - least) or 0.1 * abs(most) or 1
        # From 0, unless that would leave most of the axis without points.
        is_from_zero = axis.zero or (least >= 0 and least < 0.5 * (most + pad))
        set_limits(min(0, least) if is_from_zero else least - pad, most + pad)
    limits = [of_axis if wanted is None else wanted for of_axis, wanted in zip((axis.low, axis.high), given)]
    if getattr(ax, f"get_{which}scale")() == "log" and min((one for one in given if one is not None), default=1) <= 0:
        raise Error(f"the limits of the logarithmic axis {which} are above 0")
    if limits != [None, None]:
        set_limits(*limits)


class FileFormat(NamedTuple):
    """File format, size and limits of a figure."""

    format: str = "png"
    in_mm: bool = False  #: width and height in millimetres, with letters of 8 points
    width: float = 960  #: pixels; 96 are an inch
    height: float | None = None  #: None: as the figure needs
    x_limits: Limits = (None, None)
    y_limits: Limits = (None, None)


def draw_panel(ax: Any, panel: Panel, look: FileFormat = FileFormat(), beside: Sequence[Panel] = ()) -> list[Any]:
    """Draws the panel into given axes. `beside`: panels with the same axes. Returns the axes, and those of `y2`."""
    axes = [ax] if panel.y2 is None else [ax, ax.twinx()]
    shown = [*panel.curves, *panel.on_y2]
    palette = curve_colors(sum(curve.color is None for curve in shown))
    if panel.scale is not None:
        palette = list(COLOR_SCALE(Normalize()(panel.scale[1])))
    free, numbered = iter(palette), palette or curve_colors(MOST_COLORS)
    for one, curves, axis in zip(axes, (panel.curves, panel.on_y2), (panel.y, panel.y2 or panel.y)):
        for curve in curves:
            color = next(free) if curve.color is None else curve.color
            draw_curve(one, curve, numbered[color % len(numbered)] if isinstance(color, int) else color, axis.log)
    if panel.draw is not None:
        panel.draw(ax)
    together = [curve for one in beside or [panel] for curve in one.curves]
    parts = [part for curve in together for part in (curve.y, curve.low, curve.high) if part is not None]
    draw_axis(ax, "x", panel.x, [curve.x for curve in together], look.x_limits)
    draw_axis(ax, "y", panel.y, parts, look.y_limits)
    if panel.curves and not (panel.x.words or panel.x.log) and {*look.x_limits, panel.x.low} == {None}:
        ax.margins(x={"bars": 0.03, "points": 0.03, "sparse": 0.01}.get(shown[0].style, 0))  # whole points and bars at the ends
    if panel.y2 is not None:
        axes[1].grid(False)  # it would lie over the curves of the first axis
        draw_axis(axes[1], "y", panel.y2, [curve.y for curve in panel.on_y2])
    if panel.equal:
        ax.set_aspect("equal")
    set_labels(axes, panel)
    ax.set_title(plain_for_matplotlib(panel.title), loc="left", fontsize="medium")
    return axes


def set_labels(axes: list[Any], panel: Panel, wide: float = 1e9, high: float = 1e9, letter: float = LETTER_SIZE) -> None:
    """Sets the labels of the axes, in lines that fit into this width and height in inches."""
    axes[0].set_xlabel(wrapped(plain_for_matplotlib(panel.x.label), wide, letter))
    for ax, axis in zip(axes, (panel.y, panel.y2 or panel.y)):
        ax.set_ylabel(wrapped(plain_for_matplotlib(axis.label), high, letter))


@contextmanager
def plot_style(scale: float) -> Iterator[None]:
    """Sets our style, except for what a style of the user has set."""
    sizes = {"font.size": LETTER_SIZE, "axes.labelpad": 2, "axes.titlepad": 3}
    sizes |= {"grid.linewidth": 0.5, "axes.linewidth": 0.6, "lines.linewidth": 1.2}
    for ticks in ("xtick", "ytick"):
        sizes |= {f"{ticks}.major.width": 0.6, f"{ticks}.major.size": 2.5, f"{ticks}.minor.size": 1.5}
    ours: dict[str, Any] = {key: size * scale for key, size in sizes.items()}
    ours |= {"axes.titlesize": "medium", "figure.titlesize": "medium", "axes.grid": True, "axes.axisbelow": True}
    ours |= {"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False}
    ours |= {"grid.color": "#dcdcdc", "axes.edgecolor": "#404040", "axes.prop_cycle": cycler(color=PALETTE)}
    ours |= {"pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "clca"}
    with rc_context({key: value for key, value in ours.items() if rcParams[key] == rcParamsDefault[key]}):
        yield


def figure_bytes(chart: Chart, look: FileFormat) -> bytes:
    """Returns the bytes of the file: the same for the same tables, matplotlib and fonts."""
    unit = INCH if look.in_mm else 96
    width, height = look.width / unit, None if look.height is None else look.height / unit
    scale = 1 if look.in_mm else width / PRINT_WIDTH
    with plot_style(scale):
        figure = page_figure(chart, look, width, height, LETTER_SIZE * scale)
        out = io.BytesIO()
        none = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "constrained_layout not applied")  # page_figure() has said so
            figure.savefig(out, format=look.format, dpi=300 if look.in_mm else 96, metadata=none[look.format])
        return out.getvalue()


def page_figure(chart: Chart, look: FileFormat, width: float, height: float | None, letter: float) -> Any:
    """Returns the figure; title, legend and panels do not overlap."""
    panels = chart.panels()
    line = 1.3 * letter / 72
    columns = min(len(panels), max(1, int(width / (17 * letter / 72))), math.ceil(math.sqrt(len(panels))))
    rows = math.ceil(len(panels) / columns)
    wide = width / columns - 6 * line
    aspects = [axes_aspect(panel) for panel in panels]
    each = max(min(aspect * wide, 1.2 * width) if aspect else 0.62 * width / columns for aspect in aspects)
    if len(panels) == 1 and not aspects[0]:
        each = (0.75 if look.in_mm else 0.625) * width - 4 * line
    room = max(each, 6 * line)
    figure = Figure(figsize=(width, height or 1), layout="constrained")
    FigureCanvasAgg(figure)
    layout = figure.get_layout_engine()
    layout.set(w_pad=0.3 * line, h_pad=0.3 * line, wspace=0.02, hspace=0.02)
    places = figure.subplots(rows, columns, squeeze=False, sharex=len(panels) > 1, sharey=len(panels) > 1).ravel()
    for ax in places[len(panels) :]:
        ax.remove()
    axes = [draw_panel(ax, panel, look, panels) for ax, panel in zip(places, panels)]
    heads = [chart.title, panels[0].title if len(panels) == 1 else ""]
    title = wrapped(plain_for_matplotlib("\n".join(filter(None, heads))), width - 2 * line, letter)
    title_lines = title.count("\n") + 1 if title else 0
    most = int(0.4 * height / line) - title_lines if height else int(1.2 * rows * room / line)
    legend, legend_lines = legend_above(figure, *legend_entries(axes, panels), width - line, max(most, 1))
    above = title_lines + legend_lines
    extra = 3 * line * (len(panels) < rows * columns) + rows * (3.5 + (1.4 if any(panel.title for panel in panels) else 0)) * line
    total = height or above * line + rows * room + extra
    figure.set_size_inches(width, total)
    tall = max(total - above * line, 4 * line) / rows - 3 * line
    if min(tall, wide) < 3 * line:
        what = "width" if wide < tall else "height"
        warnings.warn(f"{chart.name}: the {what} is too small for the panels and their labels", stacklevel=2)
    for number, (those, panel) in enumerate(zip(axes, panels)):
        set_labels(those, panel, max(wide, 3 * line), max(tall, 3 * line), letter)
        panel_title = wrapped(plain_for_matplotlib(panel.title), width / columns - 3 * line, letter) if len(panels) > 1 else ""
        those[0].set_title(panel_title, loc="left")
        if len(panels) > 1:
            x_label = those[0].get_xlabel()
            those[0].label_outer()
            if number + columns >= len(panels):  # also where the last row has none
                those[0].set_xlabel(x_label)
                those[0].tick_params(labelbottom=True)
        fit_tick_labels(those[0], panel, wide, letter)
    bar = next((panel.scale for panel in panels if panel.scale is not None), None)
    if bar is not None:
        bar_of = cm.ScalarMappable(Normalize(min(bar[1]), max(bar[1])), COLOR_SCALE)
        figure.colorbar(bar_of, ax=[those[0] for those in axes], label=plain_for_matplotlib(bar[0]), aspect=30)
    margin = 0.3 * line  # equal scales are not quite what the layout has reckoned with
    left, bottom = margin / width, margin / total
    layout.set(rect=(left, bottom, 1 - 2 * left, 1 - above * line / total - 2 * bottom))
    if title:
        figure.text(0.5 * line / width, 1 - 0.25 * line / total, title, va="top", ha="left", linespacing=1.15)
    if legend is not None:
        legend.set_bbox_to_anchor((0.3 * line / width, 1 - (title_lines + 0.1) * line / total))
    return figure


def axes_aspect(panel: Panel) -> float | None:
    """Returns height over width, if both axes have one scale and limits."""
    wide, high = (math.nan if axis.low is None or axis.high is None else axis.high - axis.low for axis in (panel.x, panel.y))
    return float(high / wide) * (0.84 if panel.bar else 1) if panel.equal else None


def legend_entries(axes: Sequence[Sequence[Any]], panels: Sequence[Panel]) -> tuple[list[Any], list[str]]:
    """Returns handles and names for the legend, each once over all panels; none if there is a colour bar."""
    found: dict[str, Any] = {}
    if all(panel.scale is None for panel in panels):
        for handle, name in (pair for those in axes for ax in those for pair in zip(*ax.get_legend_handles_labels())):
            found.setdefault(plain_for_matplotlib(name), handle)
    return list(found.values()), list(found)


def legend_above(figure: Any, handles: list[Any], names: list[str], room: float, most: int) -> tuple[Any, int]:
    """Draws a legend of at most `most` lines, with the number of omitted names. Returns it and its number of lines."""
    def legend(handles: list[Any], names: list[str], columns: int) -> Any:
        space = {"borderaxespad": 0, "borderpad": 0, "handlelength": 1.6, "columnspacing": 1.2, "labelspacing": 0.25}
        made = figure.legend(handles, names, loc="upper left", ncol=columns, **space)
        made.set_in_layout(False)
        return made

    letter = rcParams["font.size"]
    widest = min(len(names), max(1, int(room * 72 / (3 * letter))))  # a column has 3 letters and more
    for columns in range(widest, 0, -1):
        lines, shown = math.ceil(len(names) / columns), (handles, names)
        if lines > most:
            lines, kept = most, columns * most - 1
            others = f"… and {len(names) - kept} more"
            shown = [*handles[:kept], Line2D([], [], linestyle="none")], [*names[:kept], others]
        made = legend(*shown, columns)
        if made.get_window_extent(figure.canvas.get_renderer()).width / figure.dpi <= room:
            return made, lines
        made.remove()
    broken = [wrapped(name, room - 4 * letter / 72, letter) for name in names]
    lines = sum(name.count("\n") + 1 for name in broken)
    if 0 < lines <= most:
        return legend(handles, broken, 1), lines
    longest = max(map(len, names), default=0)
    if longest < 12:  # there is no room for a legend
        return None, 0
    cut = [name if len(name) < longest else name[: longest - 3] + "…" for name in names]
    return legend_above(figure, handles, cut, room, most)


def fit_tick_labels(ax: Any, panel: Panel, wide: float, letter: float) -> None:
    """Rotates tick labels that do not fit."""
    width = 0.6 * letter / 72  # of a letter
    if panel.x.words:
        if sum(len(word) + 2 for word in panel.x.words) * width > wide:
            setp(ax.get_xticklabels(), rotation=30, ha="right")
    elif not panel.x.log:
        count = max(2, min(9, int(wide / (7 * width))))
        ax.xaxis.set_major_locator(ticker.MaxNLocator(count, steps=[1, 2, 2.5, 5, 10]))
    if not panel.y.log and not panel.y.words and panel.equal:
        ax.yaxis.set_major_locator(ticker.MaxNLocator("auto", steps=[1, 2, 5, 10]))
