"""Figures for notebooks, and for the command `clca plot`."""

from __future__ import annotations

from typing import Any

from . import _answer, _chart, _figures
from ._chart import Look, rendered
from ._error import Error
from ._figures import Choice
from ._folder import Run, Sweep, open


def plot(folder: Run | Sweep, name: str, ax: Any, choice: Choice) -> Any:
    """One figure into axes: those given, or new ones of pyplot in the style of the user. Returns Axes."""
    from matplotlib import pyplot  # type: ignore[import]

    found = _figures.chosen(folder, [name] if name else [], choice)
    if name:
        found = [chart for chart in found if chart.name == name] or found
    panels = found[0].panels()
    if ax is not None and len(panels) > 1:
        raise Error(f"{found[0].name} has {len(panels)} panels: call without ax, or choose by over")
    if ax is None:
        _, axes = pyplot.subplots(
            1,
            len(panels),
            squeeze=False,
            sharey=True,
            layout="constrained",
            figsize=(pyplot.rcParams["figure.figsize"][0] * min(len(panels), 3), pyplot.rcParams["figure.figsize"][1]),
        )
        all_axes = list(axes.ravel())
    else:
        all_axes = [ax]
    for one, panel in zip(all_axes, panels):
        _chart.draw_panel(one, panel)
        handles, names = _chart.legend_of([one], [panel])
        if any(names[1:]) or (names and names[0]):
            one.legend(handles, names)
    return all_axes[0] if len(all_axes) == 1 else all_axes


def command(options: dict[str, Any], folder_name: str) -> None:
    """Draws what the command asks for."""
    choice = Choice(
        **{key: tuple(value) if isinstance(value, list) else value for key, value in options.get("choice", {}).items()}
    )
    look = Look(
        **{key: tuple(value) if isinstance(value, list) else value for key, value in options.get("look", {}).items()}
    )
    for chart in _figures.chosen(open(folder_name), options["only"], choice):
        _answer.file(f"{chart.name}.{look.format}", rendered(chart, look))
