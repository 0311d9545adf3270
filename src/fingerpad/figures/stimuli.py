"""Stimuli of every condition, actuator by actuator: what dispersions and phases mean (mirrors the paper's S6)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from ..device import Condition, Device
from .style import (
    BLUE,
    GREY,
    THIN,
    VERMILLION,
    WIDE,
    as_title,
    condition_styles,
    conditions_of,
    counted,
    legend_below,
    new_figure,
    styled,
)

COLUMNS = 3  # panels beside each other
ROW_HEIGHT, TITLE_HEIGHT, LEGEND_HEIGHT = 19.0, 6.0, 16.0  # mm
MICRO = 1e3  # micrometres in a mm
BAR = 0.36  # width of a bar, of the distance between actuators [1]
HEADROOM = 1.1  # of the axes beyond the largest displacement [1]
MOST_NUMBERS = 16  # actuators up to which each has its number
CAPTION = (
    "Displacements from the pre-indented position; of a stimulus with several times, where actuators have moved"
    " farthest."
)


@styled
def stimuli_figure(devices: Sequence[Device]) -> Figure:
    """Displacement of every actuator in every condition: a block of panels a device, a row a dispersion."""
    rows = [list(_rows(device)) for device in devices]
    heights = [len(own) * ROW_HEIGHT + TITLE_HEIGHT for own in rows]
    figure = new_figure(WIDE, sum(heights) + LEGEND_HEIGHT)
    styles = condition_styles(conditions_of(devices))
    grid = figure.subplots(sum(map(len, rows)), COLUMNS, squeeze=False)
    unused = iter(grid)
    for device, own in zip(devices, rows, strict=True):
        limit = HEADROOM * (MICRO * device.stroke or 1.0)
        for number, conditions in enumerate(own):
            panels = next(unused)
            for axes, condition in zip(panels, conditions, strict=False):
                _draw(axes, _farthest(condition))
                axes.set_ylim(-limit, limit)
                axes.set_title(styles.series[device.name, condition.name].label, loc="left", fontweight="normal")
            for axes in panels[len(conditions) :]:
                axes.remove()
            panels[0].set_ylabel("Displacement\n(µm)")
            if number == 0:
                named = f"{device.title} ({counted(device.conditions)})"
                panels[0].annotate(
                    as_title(figure, named), (0.0, 1.0), xycoords="axes fraction", xytext=(0.0, 16.0),
                    textcoords="offset points", fontweight="bold", fontsize="large", va="bottom",
                )  # fmt: skip
            if number == len(own) - 1:
                for axes in panels[: len(conditions)]:
                    axes.set_xlabel("Actuator")
    handles = [
        Patch(color=BLUE, label="normal, into the skin"),
        Patch(facecolor="white", edgecolor=VERMILLION, hatch="////", label="lateral, to the right"),
    ]
    legend_below(figure, handles, CAPTION)
    return figure


def _rows(device: Device) -> Iterator[Sequence[Condition]]:
    """The conditions that stand beside each other: those of a dispersion, as many as fit."""
    for dispersion in dict.fromkeys(condition.dispersion for condition in device.conditions):
        own = [condition for condition in device.conditions if condition.dispersion == dispersion]
        for number in range(math.ceil(len(own) / COLUMNS)):
            yield own[COLUMNS * number : COLUMNS * (number + 1)]


def _farthest(condition: Condition) -> np.ndarray:
    """Sideways and normal displacements (n_actuators, 2) [µm] at the time at which an actuator has moved farthest."""
    moves = MICRO * condition.moves
    return np.asarray(moves[np.abs(moves).max(axis=(1, 2)).argmax()])


def _draw(axes: Axes, moved: np.ndarray) -> None:
    """A pair of bars an actuator: normal, and lateral."""
    number = np.arange(1, len(moved) + 1)
    lateral, normal = moved.T
    axes.bar(number - BAR / 2.0, normal, BAR, color=BLUE)
    axes.bar(number + BAR / 2.0, lateral, BAR, facecolor="white", edgecolor=VERMILLION, hatch="////", linewidth=THIN)
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    axes.set_xlim(0.5, len(moved) + 0.5)
    if len(moved) <= MOST_NUMBERS:
        axes.set_xticks(number)
    axes.yaxis.set_major_locator(MaxNLocator(3, symmetric=True))
