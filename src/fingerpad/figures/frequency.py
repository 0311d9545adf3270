"""Scores against frequency, device by device."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..scene.contact_law import Interface
from ..scene.device import Device
from ..scene.readout import Readout
from ..vibration.speed import SLOWLY
from ..words import INTERFACE_NAME, SCORE_SCALE, counted, score_label
from .style import (
    GREY,
    WIDE,
    Styles,
    as_title,
    condition_styles,
    conditions_of,
    draw_curve,
    legend_below,
    letter,
    new_figure,
    note_in,
    styled,
    subtitle,
)

ROW_HEIGHT, LEGEND_HEIGHT = 48.0, 22.0  # mm
HEADROOM = 0.1  # above the highest point, of the axis [1]
BELOW = 2.0  # slow cycles are drawn at this part of the lowest frequency [1]
CAPTION = (
    "{counted}. Small strain, viscoelastic. Slow: tissue is always relaxed. Change of strain at phase zero from the"
    " cycle's mean. No discretisation error is estimated. Marks on the axis: frequencies asked for; where a point is"
    " missing there is no prediction, and a note in frequency.csv says why."
)


@styled
def frequency_figure(devices: Sequence[Device], table: pd.DataFrame) -> Figure:
    """Change-of-strain score against frequency, with shear and without, one row per device.

    table: results/frequency.csv.
    """
    styles = condition_styles(conditions_of(devices))
    figure = new_figure(WIDE, ROW_HEIGHT * len(devices) + LEGEND_HEIGHT)
    grid = figure.subplots(len(devices), len(Interface), squeeze=False, sharey="row")
    frequencies = sorted(set(table["frequency_hz"]) - {SLOWLY})
    for row, device in zip(grid, devices, strict=True):
        own = table[(table["device"] == device.name) & (table["readout"] == Readout.CHANGE_OF_STRAIN)]
        for axes, interface in zip(row, Interface, strict=True):
            _curves(axes, own[own["interface"] == interface], styles, frequencies, device.frequencies)
        subtitle(row[0], as_title(figure, device.title, len(Interface)), INTERFACE_NAME[Interface.SHEAR])
        subtitle(row[1], " ", INTERFACE_NAME[Interface.FRICTIONLESS])
        row[0].set_ylabel(score_label(Readout.CHANGE_OF_STRAIN, str(own["unit"].iloc[0]), in_two_lines=True))
        row[0].margins(y=HEADROOM)
        row[0].set_ylim(bottom=0.0)
    for column in grid.T:
        shown = [axes for axes in column if axes.lines]
        (shown or column)[-1].set_xlabel("Frequency (Hz)")
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text)
    caption = CAPTION.format(counted=counted([cycle for device in devices for cycle in device.cycles]))
    legend_below(figure, styles.legend, caption, styles.spreads)
    return figure


def _curves(
    axes: Axes, rows: pd.DataFrame, styles: Styles, frequencies: Sequence[float], asked: Sequence[float]
) -> None:
    """One curve per condition, slow cycles to the left of a gap in the axis; marks at the frequencies asked for."""
    slow = frequencies[0] / BELOW
    axes.set_xscale("log")
    axes.set_xlim(slow / np.sqrt(BELOW), frequencies[-1] * np.sqrt(BELOW))
    axes.set_xticks([slow, *asked], ["slow", *(f"{each:g}" for each in asked)])
    axes.minorticks_off()
    if rows.empty:
        note_in(axes, "no prediction")
        return
    axes.axvline(np.sqrt(slow * frequencies[0]), color=GREY, linewidth=0.5, linestyle=(0, (2.0, 2.0)))
    scale = SCORE_SCALE[Readout.CHANGE_OF_STRAIN][0]
    curves = [(styles.series[key], own) for key, own in rows.groupby(["device", "condition"], sort=False)]
    for series, unsorted in sorted(curves, key=lambda each: each[0].fill != "full"):  # open marks over filled ones
        own = unsorted.sort_values("frequency_hz")
        places = own["frequency_hz"].replace(SLOWLY, slow).to_numpy(float)
        scores = scale * own["score"].to_numpy(float)
        for part in (slice(0, 1), slice(1, None)):
            draw_curve(axes, places[part], scores[part], series)
