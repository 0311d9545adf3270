"""One laterally driven device without and with shear (mirrors the paper's figure 6)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import INTERFACE_NAME, KINEMATICS_NAME
from .ablation import TURNING
from .correlation import caption, correlation_panel
from .style import (
    WIDE,
    as_points,
    as_title,
    condition_styles,
    legend_below,
    letter,
    new_figure,
    shown_in,
    styled,
    unknown_errors,
)

HEIGHT = 108.0  # mm
COLUMNS = (Interface.FRICTIONLESS, Interface.SHEAR)


@styled
def shear_figure(
    device: str,
    title: str,
    scores: pd.DataFrame,
    ratings: pd.DataFrame,
    correlations: pd.DataFrame,
    kinematics: Kinematics,
    turning: bool,
) -> Figure:
    """Strain (top) and change-of-strain score (bottom) against perceived roughness, without (A) and with shear (B).

    Each row has one scale, so that the two interfaces can be compared. turning: whether the contact normal turns where
    friction acts.
    """
    figure = new_figure(WIDE, HEIGHT)
    scores, ratings, correlations = (t[t["device"] == device] for t in (scores, ratings, correlations))
    styles = condition_styles(shown_in(scores))
    grid = figure.subplots(len(Readout), len(COLUMNS), sharex="row")
    for row, readout in zip(grid, Readout, strict=True):
        for axes, interface in zip(row, COLUMNS, strict=True):
            correlation_panel(axes, scores, ratings, correlations, (device, interface, readout), styles)
    for axes, interface, text in zip(grid[0], COLUMNS, "AB", strict=True):
        axes.set_title(as_title(figure, f"{title}, {INTERFACE_NAME[interface]}", len(COLUMNS)), loc="left")
        letter(axes, text)
    said = caption(correlations, f"{KINEMATICS_NAME[kinematics].capitalize()}. ") + unknown_errors(scores)
    said += TURNING if turning else ""
    legend_below(figure, as_points(styles.legend), said, as_points(styles.spreads))
    return figure
