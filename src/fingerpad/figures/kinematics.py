"""Small and finite kinematics side by side: force against indentation, and every score with shear."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import INTERFACE_NAME, KINEMATICS_NAME, several
from .bars import draw_pairs
from .style import KINEMATICS_LOOK, WIDE, as_title, legend_below, letter, new_figure, rows_with, styled

ROW_HEIGHT, LEGEND_HEIGHT = 46.0, 16.0  # mm
WIDTHS = (0.75, 1.0, 1.0)  # of the columns, relative
COLOUR = {kinematics: look["edgecolor"] for kinematics, look in KINEMATICS_LOOK.items()}
LINE: dict[Interface, Any] = {Interface.SHEAR: "-", Interface.FRICTIONLESS: (0, (1.2, 1.2))}
TITLES = 4.0  # columns as narrow as a title has to be [1]
MANY = 6  # conditions beyond which their phases stand without degrees
LIMIT = "x"  # marks a limit point
NO_LIMITS = "No force falls on the way: there are no limit points."
SMALL_ALONE = " (small strain alone)"  # of a device whose file leaves the other out
END = {Kinematics.SMALL: "o", Kinematics.FINITE: "s"}  # marks where pre-indentation ends
CAPTION = (
    "n = {scored}. Force: of all actuators, per mm of finger. Marks: where pre-indentation ends, and stimuli begin."
    " Bars: scores with shear; lines on them: estimated discretisation errors."
)


@styled
def kinematics_figure(scores: pd.DataFrame, curves: pd.DataFrame, titles: Mapping[str, str]) -> Figure:
    """Force against indentation (A), strain (B) and change-of-strain scores (C) with both kinematics, a row per device.

    scores, curves: the tables scores.csv and indentation.csv. titles: by device.
    """
    figure = new_figure(WIDE, ROW_HEIGHT * len(titles) + LEGEND_HEIGHT)
    grid = figure.subplots(len(titles), len(WIDTHS), squeeze=False, width_ratios=WIDTHS)
    for row, (device, title) in zip(grid, titles.items(), strict=True):
        pressed = curves[curves["device"] == device]
        _curves(row[0], pressed)
        row[0].set_xlabel("Indentation from first touch (mm)")
        alone = rows_with(pressed, Kinematics.FINITE).empty
        named = f"{title}{SMALL_ALONE if alone else ''}"
        row[0].set_title(as_title(figure, named, TITLES), loc="left")
        own = scores[(scores["device"] == device) & (scores["interface"] == Interface.SHEAR)]
        for axes, readout in zip(row[1:], Readout, strict=True):
            pair = [rows_with(own[own["readout"] == readout], kinematics) for kinematics in Kinematics]
            draw_pairs(axes, readout, pair, KINEMATICS_LOOK.values(), is_short=own["condition"].nunique() > MANY)
    for axes, text in zip(grid[0], "ABC", strict=True):
        letter(axes, text)
    handles: list[Any] = [Patch(label=KINEMATICS_NAME[each], **look) for each, look in KINEMATICS_LOOK.items()]
    handles += [
        Line2D([], [], color="black", linestyle=LINE[each], label=f"force {INTERFACE_NAME[each]}") for each in Interface
    ]
    limits = curves["limit_point"].astype(bool)
    if limits.any():
        handles.append(Line2D([], [], color="black", linestyle="", marker=LIMIT, label="limit point"))
    conditions = scores.drop_duplicates(["device", "condition"])
    caption = CAPTION.format(scored=several(len(conditions), "condition"))
    legend_below(figure, handles, caption if limits.any() else f"{caption} {NO_LIMITS}")
    return figure


def _curves(axes: Axes, curves: pd.DataFrame) -> None:
    """Force against indentation of one device."""
    for kinematics in Kinematics:
        for interface in Interface:
            own = rows_with(curves, kinematics)
            own = own[own["interface"] == interface]
            if len(own):
                height, force = own["indentation_mm"].to_numpy(), own["force_N_per_mm"].to_numpy()
                axes.plot(height, force, color=COLOUR[kinematics], linestyle=LINE[interface])
                limit = own["limit_point"].to_numpy(bool)
                axes.plot(height[limit], force[limit], color=COLOUR[kinematics], linestyle="", marker=LIMIT)
                axes.plot(height[-1:], force[-1:], color=COLOUR[kinematics], marker=END[kinematics], fillstyle="none")
    axes.set_ylabel("Force (N/mm)")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
