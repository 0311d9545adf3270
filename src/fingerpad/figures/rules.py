"""The rules that a run consists of, and what each waits for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from ..digraph import Edge, placed, reduced
from .style import GREY, LINE, SHADE, TEXT, WIDE, new_figure, styled

LAYER = 13.0  # distance between layers [mm]
BOX = (17.0, 7.0)  # width and height of a rule's box, where its column is that wide [mm]
GAP = 1.0  # least distance between boxes [mm]
CORNER = 1.2  # its rounding [mm]
LENGTH = 9  # characters in a line of a box; longer names break at an underscore


@styled
def rules_figure(edges: Sequence[Edge]) -> Figure:
    """Rules as boxes, from top to bottom in the order in which they can run. edges: (from, to)."""
    places, lines = placed(reduced(edges))
    height = LAYER * (1 + max(level for _, level in places.values()))
    figure = new_figure(WIDE, height)
    figure.set_layout_engine(None)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, WIDE), ylim=(height, 0.0))
    axes.axis("off")

    across = [x for line in lines for x, _ in line]
    column = WIDE / (max(across) - min(across) + 1.0)
    width = min(BOX[0], column - GAP)

    def at(place: tuple[float, int]) -> tuple[float, float]:
        return column * (place[0] - min(across) + 0.5), LAYER * (place[1] + 0.5)

    for line in lines:
        x, y = np.transpose([at(place) for place in line])
        y[[0, -1]] += BOX[1] / 2.0, -BOX[1] / 2.0  # from edge to edge: a flat line would cross a neighbour's box
        axes.plot(x, y, color=GREY, linewidth=LINE, zorder=1)
    for name, place in places.items():
        x, y = at(place)
        corner = (x - width / 2.0 + CORNER, y - BOX[1] / 2.0 + CORNER)
        size = (width - 2.0 * CORNER, BOX[1] - 2.0 * CORNER)
        axes.add_patch(
            FancyBboxPatch(corner, *size, boxstyle=f"round,pad={CORNER}", facecolor=SHADE, edgecolor=GREY, zorder=2)
        )
        axes.text(x, y, _broken(name), ha="center", va="center", fontsize=TEXT, zorder=3)
    return figure


def _broken(name: str) -> str:
    """A rule's name in lines that fit its box."""
    return name if len(name) <= LENGTH else name.replace("_", "_\n", 1)
