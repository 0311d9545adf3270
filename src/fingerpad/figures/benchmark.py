"""Run time against error on ladders of meshes, and how cost grows with the size of a scene."""

from __future__ import annotations

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter

from ..benchmark.ladders import CALCULIX_LADDER, COMPARED_AT, FIRST_ORDER_LADDER, OWN_LADDER, PLAIN_LADDER
from ..scene.tissue_law import Kinematics
from ..words import PERCENT, plain
from .style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    LETTER_NEAR,
    ORANGE,
    VERMILLION,
    WIDE,
    legend_below,
    letter,
    new_figure,
    rows_with,
    styled,
)

HEIGHT = 86.0  # mm
LADDERS = (  # solver, column, label, colour, marker
    (CALCULIX_LADDER, "cold_s", "CalculiX", BLACK, "D"),
    (PLAIN_LADDER, "cold_s", "factorised anew for every increment", GREY, "^"),
    (FIRST_ORDER_LADDER, "cold_s", "first-order elements, from scene to score", VERMILLION, "P"),
    (OWN_LADDER, "cold_s", "fingerpad, from scene to score", BLUE, "o"),
    (OWN_LADDER, "warm_s", "fingerpad, a further condition", ORANGE, "s"),
    (OWN_LADDER, "stimulus_s", "fingerpad, a further stimulus", GREEN, "v"),
)
LINES: dict[Kinematics, dict[str, Any]] = {
    Kinematics.SMALL: {},
    Kinematics.FINITE: {"linestyle": "--", "markerfacecolor": "white"},
}
CAPTION = (
    "A: {case}, with shear{finite}. The error is the larger of its two scores'. CalculiX's is against its finest mesh,"
    " so a lower bound, and its problem is easier: friction acts from the stimulus on{pressed}. All others' errors are"
    " against a finer mesh of fingerpad."
)
FINITE = "; dashed, open marks: finite strain"
LESS_DEEP = ", and with finite strain it is pressed less deep"
GROWTHS = (  # what is varied, size, seconds, label, colour, marker; colours are A's for the same seconds, marks are not
    ("mesh", "unknowns", "setup_s", "set-up, unknowns", BLUE, "X"),
    ("actuators", "actuators", "setup_s", "set-up, actuators", BLUE, "*"),
    ("mesh", "contact_nodes", "condition_s", "condition, contact nodes", ORANGE, "<"),
    ("actuators", "actuators", "condition_s", "condition, actuators", ORANGE, "*"),
    ("increments", "increments", "condition_s", "condition, increments", ORANGE, ">"),
)


@styled
def benchmark_figure(case: str, ladder: pd.DataFrame, sizes: pd.DataFrame, fits: pd.DataFrame) -> Figure:
    """A: wall time against the larger error of both scores of one condition. B: wall time against size, each over its
    smallest, with fitted exponents. case: that condition's name. ladder, sizes, fits: tables of `benchmark`.
    """
    figure = new_figure(WIDE, HEIGHT)
    left, right = figure.subplots(1, 2)
    handles = _draw_ladders(left, ladder)
    _draw_growth(right, sizes, fits)
    for axes, name in ((left, "A"), (right, "B")):
        letter(axes, name, LETTER_NEAR)
    with_finite = (ladder["kinematics"] == Kinematics.FINITE).any()
    of_finite = {"finite": FINITE, "pressed": LESS_DEEP} if with_finite else {"finite": "", "pressed": ""}
    legend_below(figure, handles, CAPTION.format(case=plain(case), **of_finite))
    return figure


def _draw_ladders(axes: Axes, ladder: pd.DataFrame) -> list[object]:
    handles: list[object] = []
    limit = PERCENT * COMPARED_AT
    for solver, column, label, colour, marker in LADDERS:
        for kinematics, line in LINES.items():
            own = rows_with(ladder[ladder["solver"] == solver], kinematics)
            if own.empty:
                continue
            error = PERCENT * own[["error_strain", "error_change_of_strain"]].max(axis=1)
            drawn = axes.plot(error, own[column], color=colour, marker=marker, label=label, **line)
            handles += drawn if kinematics is Kinematics.SMALL else []
    handles.append(axes.axvline(limit, color=GREY, linestyle=":", zorder=0, label=f"error of {limit:g} %"))
    _logarithmic(axes)
    axes.set(xlabel="Error of the score (%)", ylabel="Wall time (s)")
    axes.set_title("Time against error", loc="left")
    return handles


def _draw_growth(axes: Axes, sizes: pd.DataFrame, fits: pd.DataFrame) -> None:
    for varied, size, seconds, label, colour, marker in GROWTHS:
        own = sizes[sizes["varied"] == varied].sort_values(size)
        fit = fits[(fits["against"] == size) & (fits["seconds"] == seconds.removesuffix("_s"))]
        power = f"{label}: {fit['exponent'].iloc[0]:.2f}"
        axes.plot(
            own[size] / own[size].iloc[0], own[seconds] / own[seconds].iloc[0], color=colour, marker=marker, label=power
        )
    _logarithmic(axes)
    axes.set_xlabel("Size relative to the smallest")
    axes.set_ylabel("Wall time relative\nto the smallest size")
    axes.set_title("Growth, and its exponent", loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _logarithmic(axes: Axes) -> None:
    """Logarithmic axes whose decades are plain numbers: exponents would be too small to read."""
    axes.set(xscale="log", yscale="log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter("")
