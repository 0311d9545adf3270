"""Scores as bars, a pair for each condition: what is compared stands side by side."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from ..scene.readout import Readout
from ..words import LONGEST_LABEL, SCORE_SCALE, plain, score_label, shortened
from .style import BLACK, GREY, are_named, draw_errors, shown_in

BAR = 0.38  # width of a bar, of the distance between conditions [1]
SIDES = (-0.5, 0.5)  # middle of each bar of a pair from that of the pair, in widths of a bar [1]
GROUP_OFFSET, TURNED_OFFSET = -15.0, -23.0  # of a dispersion's name below the axis, and below upright phases [pt]
MOST_LEVEL, MOST_UPRIGHT = 10, 24  # conditions that are named beside each other on level ground, and at all, under bars
NAMES = 40  # characters of all dispersions' names under the bars


def draw_pairs(
    axes: Axes,
    readout: Readout,
    pair: Sequence[pd.DataFrame],
    looks: Iterable[Mapping[str, Any]],
    is_short: bool = False,
) -> None:
    """Bars of one device and read-out with their errors. Where a side has no score, what its note says stands instead.

    pair: rows of the score table for each side, one a condition. looks: of the bars of each side. is_short: as
    `_name_conditions` has it.
    """
    factor = SCORE_SCALE[readout][0]
    conditions = pd.concat(pair).drop_duplicates("condition")
    places = np.arange(len(conditions))
    for own, side, look in zip(pair, SIDES, looks, strict=True):
        placed = own.set_index("condition").reindex(conditions["condition"])
        heights = factor * placed["score"].to_numpy(float)
        if np.isfinite(heights).any():
            axes.bar(places + side * BAR, heights, BAR, **look)
            draw_errors(axes, places + side * BAR, heights, factor * placed["score_error"].to_numpy(float), "y", BLACK)
        elif len(own):
            for place in places:
                axes.annotate(
                    str(own["note"].iloc[0]), (place + side * BAR, 0.0), xytext=(0.0, 3.0), textcoords="offset points",
                    rotation=90.0, ha="center", va="bottom", color=GREY,
                )  # fmt: skip
    axes.set_ylabel(score_label(readout, str(conditions["unit"].iloc[0]), in_two_lines=True))
    axes.set_xlim(-2.0 * BAR, len(places) - 1.0 + 2.0 * BAR)
    _name_conditions(axes, conditions, is_short)


def _name_conditions(axes: Axes, conditions: pd.DataFrame, is_short: bool) -> None:
    """Phases under the bars, and under them the dispersions; or the conditions' names where these say too little.

    is_short: whether the axis' label has the degrees, not every phase.
    """
    places = np.arange(len(conditions))
    named = slice(None, None, math.ceil(len(places) / MOST_UPRIGHT))
    upright = len(places) > MOST_LEVEL
    if are_named(shown_in(conditions)):
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
