"""Stimuli of every condition, actuator by actuator: what dispersions and phases mean (mirrors the paper's S6)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..arrays import FloatArray
from ..scene.device import Condition, Device
from ..words import KILO, MINUS, PERCENT, counted
from .style import (
    ALONG,
    GREY,
    INTO,
    INTO_EDGE,
    TEXT,
    THIN,
    WIDE,
    as_title,
    condition_styles,
    conditions_of,
    legend_below,
    new_figure,
    styled,
)

COLUMNS = 3  # panels beside each other
ROW_HEIGHT, TITLE_HEIGHT, LEGEND_HEIGHT = 20.0, 6.0, 16.0  # mm
ROOM = 10.5  # mm that a row of panels is higher with deviations below their values
TICKS = 2  # intervals along the axis of displacements, at most
DECIMALS = 1  # of a value in micrometres
VALUE_GAP = 1.5  # between the line and a value [pt]
LINE_HEIGHT = 1.15  # of numbers in two lines, of the font size [1]
ALIKE = 0.25  # of the stroke [1], below which what actuators deviate from their mean by is not seen in their bars
BARS = 0.6  # width of an actuator's bars together, of the distance between actuators [1]
HEADROOM = 1.25  # of the axes beyond the largest displacement [1]
MOST_NUMBERS, MOST_VALUES = 16, 6  # actuators up to which each has its number, and up to which bars have their values
DELTA = "\N{GREEK CAPITAL LETTER DELTA}"
CAPTION = (
    "Displacements from the pre-indented position; of a stimulus with several times, where actuators have moved"
    " farthest, first (scores are read where strain has changed most)."
)
NUMBERS = " Numbers: values (µm), opposite their bars."
DEVIATIONS = (
    f" In brackets, where neighbours move almost alike: deviation from the mean of the row (µm). {DELTA}: between"
    " neighbours."
)
LEFT_OUT = " A direction is left out where all strokes in it are below {slight:g} % of those in the other."
SLIGHT = 0.05  # of the stroke [1], to which a direction is left out, as noise of a recording is
NEARLY = 0.95  # of the farthest [1], from which a peak is as far; of equal ones noise would choose
NORMAL, LATERAL = "normal", "lateral"
LABELS = {NORMAL: "normal, into the skin", LATERAL: "lateral, to the right"}  # in the order of a device's strokes
LOOKS: dict[str, dict[str, Any]] = {
    NORMAL: {"facecolor": INTO, "edgecolor": INTO_EDGE, "linewidth": THIN},
    LATERAL: {"facecolor": "white", "edgecolor": ALONG, "hatch": "////", "linewidth": THIN},
}


@styled
def stimuli_figure(devices: Sequence[Device]) -> Figure:
    """Displacement of every actuator in every condition: a block of panels per device, a row per dispersion."""
    rows = [(device, list(_rows(device))) for device in devices]
    row_heights = [ROW_HEIGHT + (ROOM if _has_deviations(device) else 0.0) for device in devices]
    heights = [len(own) * each + TITLE_HEIGHT for (_, own), each in zip(rows, row_heights, strict=True)]
    height = sum(heights) + LEGEND_HEIGHT
    figure = new_figure(WIDE, height)
    styles = condition_styles(conditions_of(devices))
    ratios = [each for (_, own), each in zip(rows, row_heights, strict=True) for _ in own]
    unused = iter(figure.subplots(len(ratios), COLUMNS, squeeze=False, height_ratios=ratios))
    for device, own in rows:
        named = as_title(figure, f"{device.title} ({counted(device.conditions)})")
        room = "\n" * (named.count("\n") + 1)
        for number, conditions in enumerate(own):
            panels = next(unused)
            below = len(own[number + 1]) if number + 1 < len(own) else 0
            for column, (axes, condition) in enumerate(zip(panels, conditions, strict=False)):
                _draw(axes, device, condition)
                if column >= below:
                    axes.set_xlabel("Actuator")
                label = styles.series[device.name, condition.name].label + _apart(device, condition)
                axes.set_title(f"{room if number == 0 else ''}{label}", loc="left", fontweight="normal")
            for axes in panels[len(conditions) :]:
                axes.remove()
            if number == 0:
                title = panels[0].annotate(
                    named, (0.0, 1.0), xycoords="axes fraction", xytext=(0.0, 16.0), textcoords="offset points",
                    fontweight="bold", fontsize="large", va="bottom",
                )  # fmt: skip
                title.set_in_layout(False)  # its room is that of the panels' titles, whose first lines are empty
    figure.supylabel("Displacement (µm)", fontsize=TEXT, y=1.0 - 0.5 * sum(heights) / height)
    drawn = {kind for device in devices for kind in _directions(device)}
    handles = [Patch(label=label, **LOOKS[kind]) for kind, label in LABELS.items() if kind in drawn]
    legend_below(figure, handles, _caption(devices))
    return figure


def _rows(device: Device) -> Iterator[Sequence[Condition]]:
    """The conditions that stand beside each other: those of a dispersion, as many as fit."""
    for own in device.by_dispersion.values():
        for number in range(math.ceil(len(own) / COLUMNS)):
            yield own[COLUMNS * number : COLUMNS * (number + 1)]


def _farthest(condition: Condition) -> dict[str, FloatArray]:
    """Displacements (n_actuators,) [µm] by direction at the first peak that is about as far as the farthest."""
    moves = KILO * condition.moves
    far = np.abs(moves).max(axis=(1, 2))
    before, after = np.pad(far, (1, 0))[:-1], np.pad(far, (0, 1))[1:]
    first = np.flatnonzero((far >= before) & (far >= after) & (far >= NEARLY * far.max()))[0]
    lateral, normal = moves[first].T
    return {NORMAL: normal, LATERAL: lateral}


def _directions(device: Device) -> list[str]:
    """Directions in which a device moves, but for next to nothing."""
    return [kind for kind, stroke in zip(LABELS, device.strokes, strict=True) if stroke > SLIGHT * device.stroke]


def _has_values(device: Device) -> bool:
    """Whether bars have room for their values."""
    return len(_directions(device)) == 1 and len(device.actuators.positions) <= MOST_VALUES


def _deviations(device: Device, condition: Condition) -> FloatArray:
    """By how much actuators' displacements (n_actuators,) [µm] differ from their mean, in the one direction shown."""
    shown = _farthest(condition)[_directions(device)[0]]
    return np.asarray(shown - shown.mean())


def _has_deviations(device: Device) -> bool:
    """Whether actuators differ by so little that their bars do not show it."""
    if not _has_values(device):
        return False
    largest = max(float(np.abs(_deviations(device, each)).max()) for each in device.conditions)
    return 0.5 * 10.0**-DECIMALS <= largest < ALIKE * KILO * device.stroke


def _apart(device: Device, condition: Condition) -> str:
    """The mean of a row and how far apart neighbours move, where bars do not show it and all are as far."""
    if not _has_deviations(device):
        return ""
    shown = _farthest(condition)[_directions(device)[0]]
    mean, apart = _number(float(shown.mean())), np.abs(np.diff(shown)).round(DECIMALS)
    return f": mean {mean}{f', {DELTA} {_number(float(apart[0]))}' if np.ptp(apart) == 0.0 else ''} µm"


def _number(value: float) -> str:
    """A value in micrometres as it is shown."""
    return f"{round(value, DECIMALS) + 0.0:g}".replace("-", MINUS)


def _caption(devices: Sequence[Device]) -> str:
    """What bars and numbers are."""
    slight = any(0.0 < min(device.strokes) <= SLIGHT * device.stroke for device in devices)
    numbers = NUMBERS if any(map(_has_values, devices)) else ""
    numbers += DEVIATIONS if any(map(_has_deviations, devices)) else ""
    return CAPTION + numbers + (LEFT_OUT.format(slight=PERCENT * SLIGHT) if slight else "")


def _draw(axes: Axes, device: Device, condition: Condition) -> None:
    """A bar an actuator, or two where the device moves in both directions."""
    stroke, count = KILO * device.stroke, len(device.actuators.positions)
    number = np.arange(1, count + 1)
    directions = _directions(device)
    for place, kind in enumerate(directions):
        width = BARS / len(directions)
        across, heights = number + ((place + 0.5) * width - BARS / 2.0), _farthest(condition)[kind]
        axes.bar(across, heights, width, **LOOKS[kind])
        if _has_values(device):
            _write_values(axes, across, heights, _deviations(device, condition) if _has_deviations(device) else None)
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    axes.set_xlim(0.5, count + 0.5)
    if count <= MOST_NUMBERS:
        axes.set_xticks(number)
    if stroke > 0.0:
        axes.set_ylim(-HEADROOM * stroke, HEADROOM * stroke)
        axes.locator_params(axis="y", nbins=TICKS, symmetric=True)


def _write_values(axes: Axes, across: Iterable[float], heights: FloatArray, deviations: FloatArray | None) -> None:
    """Heights of bars as numbers on the other side of the line, where there is room, and their deviations, if there are
    any, beyond.
    """
    for number, (x, height) in enumerate(zip(across, heights, strict=True)):
        is_up = height > 0.0
        told = [_number(height)]
        if deviations is not None:
            signed = _number(float(deviations[number]))
            told.append(f"({signed if signed.startswith(MINUS) or signed == '0' else f'+{signed}'})")
        for line, text in enumerate(told):
            away = VALUE_GAP + line * LINE_HEIGHT * TEXT
            axes.annotate(
                text, (x, 0.0), xytext=(0.0, -away if is_up else away), textcoords="offset points", ha="center",
                va="top" if is_up else "bottom", color="black" if line == 0 else GREY,
            )  # fmt: skip
