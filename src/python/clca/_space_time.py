"""Draws axes and legend around the pixels of `clca render --space-time`."""

import io
import sys
from typing import Any

from matplotlib import rcParams  # type: ignore[import]
from matplotlib.cm import ScalarMappable  # type: ignore[import]
from matplotlib.colors import Normalize  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.image import imread  # type: ignore[import]
from matplotlib.patches import Patch  # type: ignore[import]
from matplotlib.transforms import ScaledTranslation  # type: ignore[import]

from . import _answer
from ._chart import PRINT_WIDTH, plain_for_matplotlib, plot_style


def rgb_shares(color: dict[str, int]) -> tuple[float, ...]:
    return tuple(color[channel] / 255 for channel in ("red", "green", "blue"))


def annotate(figure: Any, ax: Any, shown: dict[str, Any]) -> None:
    """Draws title, axes, stages and legend."""
    figure.suptitle(plain_for_matplotlib(shown["title"]), x=0.01, ha="left")
    ax.set(xlabel=plain_for_matplotlib(shown["time"]["label"]), ylabel=plain_for_matplotlib(shown["position"]["label"]))
    ends = [stage["begin"] for stage in shown["stages"][1:]] + [shown["time"]["high"]]
    for stage, end in zip(shown["stages"], ends):
        begin = max(stage["begin"], shown["time"]["low"])
        if begin > shown["time"]["low"]:
            ax.axvline(begin, color="black", linewidth=0.8)
        if end - begin > 0.05 * (shown["time"]["high"] - shown["time"]["low"]) and ends[1:]:
            name = plain_for_matplotlib(stage["name"])
            ax.text((begin + end) / 2, 1.01, name, transform=ax.get_xaxis_transform(), ha="center", color="#60666e")
    for bar in shown["legend"]["bars"]:
        extend = ("neither", "min", "max", "both")[bar["below"] + 2 * bar["above"]]
        values = ScalarMappable(Normalize(bar["low"], bar["high"]), "coolwarm" if bar["diverging"] else "viridis")
        figure.colorbar(values, ax=ax, label=plain_for_matplotlib(bar["label"]), extend=extend, aspect=30, pad=0.02)
    handles = [
        Patch(facecolor=rgb_shares(patch["color"]), edgecolor="#404040", linewidth=0.5, label=plain_for_matplotlib(patch["label"]))
        for patch in shown["legend"]["patches"]
    ]
    if handles:
        below = ax.transAxes + ScaledTranslation(0, -3.2 * rcParams["font.size"] / 72, figure.dpi_scale_trans)
        space = {"borderaxespad": 0, "handlelength": 1, "columnspacing": 1.2}
        ax.legend(handles=handles, loc="upper left", bbox_to_anchor=(0, 0), bbox_transform=below, ncol=6, **space)


def command(shown: dict[str, Any]) -> None:
    """Answers with the picture. Standard input is a PNG of the area between its axes."""
    content = imread(io.BytesIO(sys.stdin.buffer.read()), format="png")
    width, height = shown["width"] / 96, shown["height"] / 96
    with plot_style(width / PRINT_WIDTH):
        figure = Figure(figsize=(width, height), dpi=96, layout="constrained" if shown["annotations"] else None)
        ax = figure.add_subplot() if shown["annotations"] else figure.add_axes((0, 0, 1, 1))
        extent = [shown[axis][end] for axis in ("time", "position") for end in ("low", "high")]
        ax.imshow(content, extent=extent, aspect="auto")
        ax.grid(False)
        if shown["annotations"]:
            annotate(figure, ax, shown)
        else:
            ax.set_axis_off()
        out = io.BytesIO()
        figure.savefig(out, format="png", metadata=shown["text"])
    _answer.send_file("picture.png", out.getvalue())
