"""Scores with and without shear, for every device and both read-outs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..perception.wording import range_text, slope_name
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import INTERFACE_NAME, KINEMATICS_NAME, LONGEST_LABEL, SCORE_SCALE, plain, score_label, shortened
from .correlation import ratings_caption
from .style import BLUE, GREY, ORANGE, WIDE, as_title, draw_errors, legend_below, letter, new_figure, styled

ROW_HEIGHT, LEGEND_HEIGHT = 46.0, 14.0  # mm
BAR = 0.38  # width of a bar, of the distance between conditions [1]
GROUP_OFFSET, TURNED_OFFSET = -15.0, -23.0  # of a dispersion's name below the axis, and below upright phases [pt]
MOST_LEVEL, MOST_UPRIGHT = 10, 24  # conditions that are named beside each other on level ground, and at all, under bars
NAMES = 40  # characters of all dispersions' names under the bars
# what else differs between the interfaces where the contact normal turns under friction (docs/decisions/0021)
TURNING = " With shear the contact normal turns on rounded edges, which press sideways; without shear it does not."
LOOK: dict[Interface, dict[str, Any]] = {
    Interface.SHEAR: {"facecolor": BLUE, "edgecolor": BLUE},
    Interface.FRICTIONLESS: {"facecolor": "white", "edgecolor": ORANGE, "hatch": "//////"},
}


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
            xytext=(0.0, 26.0), textcoords="offset points", fontweight="bold", fontsize="large",
        )  # fmt: skip
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text, (-30.0, 26.0))
    handles = [Patch(label=INTERFACE_NAME[interface], **LOOK[interface]) for interface in Interface]
    shown = correlations[correlations["device"].isin(titles)]
    turned = TURNING if turning else ""
    legend_below(figure, handles, f"{KINEMATICS_NAME[kinematics].capitalize()}.{ratings_caption(shown)}{turned}")
    return figure


def _panel(axes: Axes, readout: Readout, scores: pd.DataFrame, correlations: pd.DataFrame) -> None:
    """Bars of one device and read-out, a pair for each condition."""
    factor = SCORE_SCALE[readout][0]
    wide = scores.pivot(index="condition", columns="interface", values="score")
    spread = scores.pivot(index="condition", columns="interface", values="score_error")
    conditions = scores.drop_duplicates("condition")
    places = np.arange(len(conditions))
    for interface, side in zip(Interface, (-0.5, 0.5), strict=True):
        heights = factor * wide.reindex(conditions["condition"])[interface].to_numpy(float)
        if np.isfinite(heights).any():
            axes.bar(places + side * BAR, heights, BAR, **LOOK[interface])
            errors = factor * spread.reindex(conditions["condition"])[interface].to_numpy(float)
            draw_errors(axes, places + side * BAR, heights, errors, along="y")
        else:
            note = str(scores.loc[scores["interface"] == interface, "note"].iloc[0])
            for place in places:
                axes.annotate(
                    note, (place + side * BAR, 0.0), xytext=(0.0, 3.0), textcoords="offset points", rotation=90.0,
                    ha="center", va="bottom", color=GREY,
                )  # fmt: skip
    axes.set_ylabel(score_label(readout, str(scores["unit"].iloc[0]), in_two_lines=True))
    axes.set_xlim(-2.0 * BAR, len(places) - 1.0 + 2.0 * BAR)
    name_conditions(axes, conditions)
    lines = [_statistics(correlations, interface) for interface in Interface]
    axes.set_title("\n".join(lines), loc="left", fontsize="medium", fontweight="normal")


def name_conditions(axes: Axes, conditions: pd.DataFrame, is_short: bool = False) -> None:
    """Phases under the bars, and under them the dispersions; or the conditions' names where these say too little.

    is_short: whether the axis' label has the degrees, not every phase.
    """
    places = np.arange(len(conditions))
    named = slice(None, None, math.ceil(len(places) / MOST_UPRIGHT))
    upright = len(places) > MOST_LEVEL
    if conditions.duplicated(["dispersion", "phase_deg"]).any():
        names = [shortened(name) for name in conditions["condition"]]
        turned: dict[str, Any] = {"rotation": 20.0, "ha": "right"} if sum(map(len, names)) > NAMES else {}
        turned = {"rotation": 90.0} if upright else turned
        axes.set_xticks(places[named], names[named], **turned)
        return
    phases = [f"{phase:g}{'' if is_short else '°'}" for phase in conditions["phase_deg"]]
    axes.set_xticks(places[named], phases[named], rotation=90.0 if upright else 0.0)
    offset = TURNED_OFFSET if upright else GROUP_OFFSET
    said = "Phase difference (°)" if is_short else "Phase difference"
    if conditions["dispersion"].nunique() == 1:
        axes.set_xlabel(said)
        return
    axes.set_xlabel(f"{said}, dispersion", labelpad=-GROUP_OFFSET / 1.5)
    groups = conditions["dispersion"].unique()
    for name in groups:
        centre = float(places[(conditions["dispersion"] == name).to_numpy()].mean())
        axes.annotate(
            shortened(plain(name), min(LONGEST_LABEL, NAMES // len(groups))), (centre, 0.0),
            xycoords=axes.get_xaxis_transform(), xytext=(0.0, offset), textcoords="offset points",
            ha="center", va="top",
        )  # fmt: skip


def _statistics(correlations: pd.DataFrame, interface: Interface) -> str:
    """One line on how scores at an interface correlate with the ratings."""
    row = correlations[correlations["interface"] == interface].iloc[0]
    if pd.isna(row["r2"]):
        return f"{INTERFACE_NAME[interface]}: {row['note']}"
    ends = f", range {range_text(row)}" if range_text(row) else ""
    return f"{INTERFACE_NAME[interface]}: R² {row['r2']:.3f}, {slope_name(row)}{ends}, n = {row['n']}"
