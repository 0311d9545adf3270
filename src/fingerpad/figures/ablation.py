"""Scores with and without shear, for every device and both read-outs."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..perception.wording import SURROGATE, is_surrogate, r2_text, range_text, slope_name
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import INTERFACE_NAME, KINEMATICS_NAME
from .bars import draw_pairs
from .correlation import ratings_caption
from .style import (
    INTERFACE_LOOK,
    LETTER_OFFSET,
    WIDE,
    as_title,
    legend_below,
    letter,
    new_figure,
    styled,
    unknown_errors,
)

ROW_HEIGHT, LEGEND_HEIGHT = 46.0, 14.0  # mm
RISE = 26.0  # of devices' titles and of letters above panels, over two lines of statistics [pt]
ERRORS = " Lines on bars: estimated discretisation errors."
# what else differs between the interfaces where the contact normal turns under friction (docs/decisions/0021)
TURNING = " With shear the contact normal turns on rounded edges, which press sideways; without shear it does not."


@styled
def ablation_figure(
    scores: pd.DataFrame,
    correlations: pd.DataFrame,
    titles: Mapping[str, str],
    kinematics: Kinematics,
    turning: bool,
) -> Figure:
    """Strain (A) and change-of-strain scores (B) of every condition with and without shear, one row per device.

    scores, correlations: the tables of that name. titles: by device. turning: whether the contact normal turns where
    friction acts.
    """
    figure = new_figure(WIDE, ROW_HEIGHT * len(titles) + LEGEND_HEIGHT)
    grid = figure.subplots(len(titles), len(Readout), squeeze=False)
    for row, (device, title) in zip(grid, titles.items(), strict=True):
        for axes, readout in zip(row, Readout, strict=True):
            chosen = [t[(t["device"] == device) & (t["readout"] == readout)] for t in (scores, correlations)]
            _panel(axes, readout, *chosen)
        row[0].annotate(
            as_title(figure, title, len(Readout)), (0.0, 1.0), xycoords="axes fraction",
            xytext=(0.0, RISE), textcoords="offset points", fontweight="bold", fontsize="large",
        )  # fmt: skip
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text, (LETTER_OFFSET[0], RISE))
    handles = [Patch(label=INTERFACE_NAME[each], **look) for each, look in INTERFACE_LOOK.items()]
    shown = correlations[correlations["device"].isin(titles)]
    turned, unknown = TURNING if turning else "", unknown_errors(scores[scores["device"].isin(titles)])
    legend_below(
        figure, handles, f"{KINEMATICS_NAME[kinematics].capitalize()}.{ratings_caption(shown)}{ERRORS}{unknown}{turned}"
    )
    return figure


def _panel(axes: Axes, readout: Readout, scores: pd.DataFrame, correlations: pd.DataFrame) -> None:
    """Bars of one device and read-out, a pair for each condition."""
    draw_pairs(
        axes, readout, [scores[scores["interface"] == interface] for interface in Interface], INTERFACE_LOOK.values()
    )
    lines = [_statistics(correlations, interface) for interface in Interface]
    axes.set_title("\n".join(lines), loc="left", fontsize="medium", fontweight="normal")


def _statistics(correlations: pd.DataFrame, interface: Interface) -> str:
    """One line on how scores at an interface correlate with the ratings."""
    row = correlations[correlations["interface"] == interface].iloc[0]
    if pd.isna(row["r2"]):
        return f"{INTERFACE_NAME[interface]}: {row['note']}"
    slope, between = slope_name(row), range_text(row)
    if is_surrogate(row):
        said = f"{slope}, R² range {between}" if between else f"{slope}, {SURROGATE} = {r2_text(row)}"
    else:
        said = f"R² = {r2_text(row)}, {slope}{f', range {between}' if between else ''}"
    return f"{INTERFACE_NAME[interface]}: {said}, n = {row['n']}"
