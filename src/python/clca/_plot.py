"""Figures for notebooks, and for the command `clca plot`."""

from __future__ import annotations

import json
import sys
from typing import Any

from . import _chart, _figures
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
    """Draws what the command asks for to standard output: of each figure a line of JSON, then its bytes."""
    folder = open(folder_name)
    choice = Choice(
        **{key: tuple(value) if isinstance(value, list) else value for key, value in options["choice"].items()}
    )
    limits = {key: tuple(value) for key, value in options["look"].items() if key.endswith("_limits")}
    look = Look(**{**options["look"], **limits})
    out = sys.stdout.buffer
    if options.get("report"):
        warnings: list[str] = []
        found = sorted(
            _figures.charts(folder, choice, lambda error: warnings.append(str(error))), key=lambda one: -one.rank
        )
        for warning in warnings:
            out.write(json.dumps({"warning": warning}).encode() + b"\n")
        found = [chart._replace(title="") for chart in found[: options["report"]]]
    else:
        found = _figures.chosen(folder, options["only"], choice)
    for chart in found:
        picture, kind = rendered(chart, look), look.format
        if options.get("report") and len(picture) > 300_000:
            kind = "png"
            picture = rendered(chart, look._replace(format=kind, width=2 * look.width))
        head = {"name": chart.name, "about": chart.about, "format": kind, "bytes": len(picture)}
        out.write(json.dumps(head).encode() + b"\n" + picture)
        out.flush()
