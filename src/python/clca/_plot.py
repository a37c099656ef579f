"""Figures for notebooks, and for the command `clca plot`."""

from typing import Any

from . import _answer, _figures
from ._arguments import argument_error
from ._chart import FileFormat, draw_panel, legend_entries, figure_bytes
from ._error import Error
from ._figures import FigureChoice
from ._folder import Run, Sweep, open

MOST_FIGURES = 20  # of one call: pyplot keeps them all


def plot(folder: Run | Sweep, name: str, ax: Any, choice: FigureChoice) -> Any:
    """Draws figures into the given axes, or into new ones of pyplot in the style of the user. Returns Axes."""
    from matplotlib import pyplot  # type: ignore[import]

    if not isinstance(ax, (pyplot.Axes, type(None))):
        raise argument_error("ax", "Axes of matplotlib", ax)
    found = _figures.chosen_charts(folder, [name] if name else [], choice)
    if len(found) > (most := MOST_FIGURES if ax is None else 1):
        there = ", ".join(chart.name for chart in found)
        takes = f"the {most} of one call" if ax is None else "the one that ax takes"
        raise Error(f"{folder.folder}: {len(found)} figures, more than {takes}: choose by name, y or stage; there are {there}")
    drawn: list[Any] = []
    for chart in found:
        panels = chart.panels()
        if ax is not None and len(panels) > 1:
            raise Error(f"{chart.name} has {len(panels)} panels: call without ax, or choose by over")
        axes: Any = [ax]
        if ax is None:
            wide, high = pyplot.rcParams["figure.figsize"]
            size = (wide * min(len(panels), 3), high)
            axes = pyplot.subplots(1, len(panels), squeeze=False, sharey=True, layout="constrained", figsize=size)[1][0]
        for one, panel in zip(axes, panels):
            handles, names = legend_entries([draw_panel(one, panel)], [panel])
            if names:
                one.legend(handles, names)
        drawn.extend(axes)
    return drawn[0] if len(drawn) == 1 else drawn


def parsed_limits(text: str) -> tuple[float | None, float | None]:
    """Returns the limits of an axis from `LOW:HIGH`."""
    low, _, high = text.partition(":")
    return parsed_number(low), parsed_number(high)


def parsed_number(text: str | None) -> float | None:
    return float(text) if text else None


def command(options: dict[str, Any], folder: str) -> None:
    """Draws the figures of the command."""
    choice = FigureChoice(
        **{key: options[key] for key in ("x", "y", "over", "y2", "log") if key in options},
        stages=options.get("stage", ()),
        first=parsed_number(options.get("from")),
        last=parsed_number(options.get("to")),
        filling="no-filling" not in options,
        mean=int(options.get("running-mean", 1)),
    )
    sizes = [options.get("width", "960"), options.get("height")]
    in_mm = [size.endswith("mm") for size in sizes if size]
    if len(set(in_mm)) > 1:
        raise Error("--width and --height: both in pixels, or both in mm")
    width, height = (parsed_number(size and size.removesuffix("mm")) for size in sizes)
    ranges = (parsed_limits(options.get(f"{axis}-range", "")) for axis in "xy")
    look = FileFormat(options.get("format", "png"), in_mm[0], width or 0, height, *ranges)
    source = open(folder)
    drawn = _figures.chosen_charts(source, options.get("only", []), choice)
    for chart in drawn:
        _answer.send_file(f"{chart.name}.{look.format}", figure_bytes(chart, look))
    if not options.get("only") and not choice.y and (choice.first, choice.last, choice.stages) != (None, None, ()):
        every = _figures.charts(source, choice._replace(first=None, last=None, stages=()))
        if empty := [chart.name for chart in every if chart.name not in _figures.chart_names(drawn)]:
            _answer.send_files_and_lines([], [f"no rows in the stages and times that are chosen: {', '.join(empty)}"])
