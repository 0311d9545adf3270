"""Scores between the phases at which devices are tried."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from string import ascii_uppercase

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..readouts.roughness import SCORE_UNIT
from ..scene.device import Device
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME, SCORE_SCALE, counted, score_label
from .style import (
    BLACK,
    MARKERS,
    MIDDLE,
    SHADE,
    THIN,
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
    rows_with,
    styled,
    subtitle,
    unknown_errors,
)

ROW_HEIGHT, LEGEND_HEIGHT = 46.0, 26.0  # mm
TICKS = 45.0  # deg
CAPTION = (
    "{counted}, with shear. Vertical bars: estimated discretisation errors; where none is seen it is smaller than the"
    " mark. Grey lines: phases in the device's file. The mesh is made for all phases together, so that scores at these"
    " differ from scores.csv within their errors. A score orders the conditions of one device."
)
MISSING = " Where a point is missing there is no prediction."


@styled
def phases_figure(devices: Sequence[Device], table: pd.DataFrame) -> Figure:
    """Change-of-strain score against phase, one row per device, one column per kinematics.

    devices: as they are tried, in the order of the rows. table: rows of `prediction.phases.phase_rows`.
    """
    change = table[table["readout"] == Readout.CHANGE_OF_STRAIN]
    kinematics = list(change["kinematics"].unique())
    styles = condition_styles(conditions_of(devices))
    figure = new_figure(MIDDLE, ROW_HEIGHT * len(devices) + LEGEND_HEIGHT)
    grid = figure.subplots(len(devices), len(kinematics), squeeze=False, sharex=True)
    for row, device in zip(grid, devices, strict=True):
        own = change[change["device"] == device.name]
        looks = {
            dispersion: replace(styles.series[device.name, conditions[0].name], colour=BLACK, marker=MARKERS[0])
            for dispersion, conditions in device.by_dispersion.items()
        }
        for axes, each in zip(row, kinematics, strict=True):
            _curves(axes, rows_with(own, each), looks, sorted({one.phase_deg for one in device.conditions}))
            first = axes is row[0]
            subtitle(axes, as_title(figure, device.title, len(kinematics)) if first else " ",
                     KINEMATICS_NAME[Kinematics(each)])  # fmt: skip
        row[0].set_ylabel(score_label(Readout.CHANGE_OF_STRAIN, SCORE_UNIT, in_two_lines=True))
    for axes in grid[-1]:
        axes.set_xlabel("Phase difference (°)")
    for axes, text in zip(grid.flat, ascii_uppercase, strict=False):
        letter(axes, text)
    missing = MISSING if change["score"].isna().any() else ""
    tried = change[["device", "dispersion", "phase_deg"]].drop_duplicates()
    caption = CAPTION.format(counted=counted(tried.index))
    legend_below(figure, styles.spreads, caption + unknown_errors(change) + missing)
    return figure


def _curves(axes: Axes, rows: pd.DataFrame, looks: dict[str, Series], tried: Sequence[float]) -> None:
    """One curve per dispersion, and lines at the phases that are tried."""
    if rows.empty:
        note_in(axes, "no prediction")
        return
    scale = SCORE_SCALE[Readout.CHANGE_OF_STRAIN][0]
    for phase in tried:
        axes.axvline(phase, color=SHADE, linewidth=2.0 * THIN, zorder=0)
    for dispersion, own in rows.groupby("dispersion", sort=False):
        phases, scores, errors = (own[column].to_numpy(float) for column in ("phase_deg", "score", "score_error"))
        draw_errors(axes, phases, scale * scores, scale * errors, along="y")
        draw_curve(axes, phases, scale * scores, looks[str(dispersion)])
    axes.set_xticks(np.arange(0.0, rows["phase_deg"].max() + TICKS / 2.0, TICKS))
    axes.set_ylim(bottom=0.0)
