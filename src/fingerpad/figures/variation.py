"""Scores of a device against a value that is varied."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..readouts.roughness import SCORE_UNIT, rows_of
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..words import INTERFACE_NAME, KINEMATICS_NAME, LONGEST_LABEL, SCORE_SCALE, plain, score_label, shortened
from .style import (
    WIDE,
    Series,
    as_title,
    condition_styles,
    conditions_of,
    draw_curve,
    draw_errors,
    legend_below,
    letter,
    new_figure,
    note_in,
    styled,
    subtitle,
)

ROW_HEIGHT, LEGEND_HEIGHT = 52.0, 26.0  # mm
BARS = "Vertical bars: estimated discretisation errors. "
CAPTION = (
    "Where a point is missing there is no prediction. A score orders the conditions of one device: whether it compares"
    " devices has not been tested."
)

Rows = Sequence[Mapping[str, Any]]

LONGEST_TOLD = 60  # characters of a value in the caption


@styled
def variation_figure(
    key: str, unit: str, values: Sequence[Any], scenes: Sequence[Scene], tables: Sequence[Rows]
) -> Figure:
    """Strain (above) and change-of-strain scores (below) of every condition, a column for each interface.

    key, unit: of what is varied, and its values: numbers, or anything else, which is drawn side by side. scenes,
    tables: of one device with each of the values, and rows of its score table.
    """
    first = scenes[0]
    styles = condition_styles(each for scene in scenes for each in conditions_of([scene.device]))
    interfaces = [each for each in Interface if any(each in scene.device.interfaces() for scene in scenes)]
    figure = new_figure(WIDE, ROW_HEIGHT * len(Readout) + LEGEND_HEIGHT)
    grid = figure.subplots(len(Readout), len(interfaces), squeeze=False, sharey="row", sharex=True)
    are_numbers = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
    places = np.array(values, dtype=float) if are_numbers else np.arange(len(values), dtype=float)
    order = np.argsort(places, kind="stable")  # curves run from left to right, however values were given
    places, tables = places[order], [tables[each] for each in order]
    for row, readout in zip(grid, Readout, strict=True):
        for axes, interface in zip(row, interfaces, strict=True):
            own = [rows_of(rows, interface, readout) for rows in tables]
            _curves(axes, readout, places, own, styles.series)
        row[0].set_ylabel(score_label(readout, SCORE_UNIT))
    labels, told = _labels(values)
    for axes in grid[-1]:
        axes.set_xlabel(plain(key) if unit == "1" else f"{plain(key)} ({unit})")
        if not are_numbers:
            axes.set_xticks(places, labels)
    title = as_title(figure, f"{first.device.title}, {KINEMATICS_NAME[first.kinematics]}", len(interfaces))
    for axes, interface in zip(grid[0], interfaces, strict=True):
        subtitle(axes, title if interface is Interface.SHEAR else " ", INTERFACE_NAME[interface])
    for axes, text in zip(grid.flat, "ABCD", strict=False):
        letter(axes, text)
    has_errors = any(row["score_error"] is not None for rows in tables for row in rows)
    caption = f"{BARS if has_errors else ''}{CAPTION}{'' if are_numbers else told}"
    legend_below(figure, styles.legend, caption, styles.spreads)
    return figure


def _labels(values: Sequence[Any]) -> tuple[list[str], str]:
    """What stands at an axis for values that are no numbers: if they are too long for that, numbers, and a caption says
    of which value each is.
    """
    written = [plain(str(value)).replace(", ", ",") for value in values]
    if max(map(len, written)) <= LONGEST_LABEL:
        return written, ""
    numbers = [str(1 + number) for number in range(len(values))]
    told = (f"{number}: {shortened(text, LONGEST_TOLD)}" for number, text in zip(numbers, written, strict=True))
    return numbers, f" {'; '.join(told)}."


def _curves(
    axes: Axes,
    readout: Readout,
    places: np.ndarray,
    tables: Sequence[Rows],
    series: Mapping[tuple[str, str], Series],
) -> None:
    """One curve per condition, broken where it has no score."""
    scale = SCORE_SCALE[readout][0]
    if all(row["score"] is None for rows in tables for row in rows):
        note_in(axes, "no prediction")
        return
    for (_, condition), look in series.items():
        by_value = [next((row for row in rows if row["condition"] == condition), {}) for rows in tables]
        scores, errors = (
            scale * np.array([row.get(column) for row in by_value], dtype=float) for column in ("score", "score_error")
        )
        draw_errors(axes, places, scores, errors, along="y")
        draw_curve(axes, places, scores, look)
