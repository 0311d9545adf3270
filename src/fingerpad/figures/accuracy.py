"""Error of every closed form against the size of elements, with its tolerance."""

from __future__ import annotations

from string import ascii_uppercase
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from ..closedforms.comparison import ORDER_OF
from ..scene.tissue_law import Kinematics
from .style import COLOURS, GREY, LETTER_NEAR, MARKERS, WIDE, legend_below, letter, new_figure, styled

COLUMNS = 3
TYPESET = {
    "exx": "\N{GREEK SMALL LETTER EPSILON}xx",
    "eyy": "\N{GREEK SMALL LETTER EPSILON}yy",
    "gxy": "\N{GREEK SMALL LETTER GAMMA}xy",
    "nu = ": "\N{GREEK SMALL LETTER NU} = ",
    "mu = ": "\N{GREEK SMALL LETTER MU} = ",
    "neo_hookean": "neo-Hookean",
    "hencky": "Hencky",
    "ogden": "Ogden",
    "green": "Green",
}
ROW_HEIGHT, LEGEND_HEIGHT = 45.0, 13.0  # mm
FINITE_CASES = ("Finite", "Bent")  # how cases with finite kinematics begin
CAPTION = (
    "Where not all quantities of a panel are held to one tolerance, tolerances have the colours of their quantities."
)
BASE_SIZE, LARGER = 3.6, 1.2  # pt: the mark of a panel's last curve, and how much larger each before it is, to be seen
LABELS = 3  # of a legend in one column [1]; more are short, and stand in two
LABEL_HEIGHT, MARGIN = 0.145, 0.06  # of a label of a legend, and around all, of a panel's height [1]


@styled
def accuracy_figure(rows: pd.DataFrame, kinematics: Kinematics) -> Figure:
    """One panel per case with those kinematics, one curve per quantity. rows: the table of closed forms."""
    finite = kinematics is Kinematics.FINITE
    cases = [case for case in dict.fromkeys(rows["case"]) if case.startswith(FINITE_CASES) is finite]
    lines = -(-len(cases) // COLUMNS)
    shown = rows[rows["case"].isin(cases)]
    figure = new_figure(WIDE, ROW_HEIGHT * lines + LEGEND_HEIGHT)
    grid = figure.subplots(lines, COLUMNS, squeeze=False).ravel()
    for axes, case, name in zip(grid[: len(cases)], cases, ascii_uppercase[: len(cases)], strict=True):
        _panel(axes, rows[rows["case"] == case])
        axes.set_title(_typeset(case), loc="left")
        letter(axes, name, LETTER_NEAR)
    for axes in grid[len(cases) :]:
        axes.set_axis_off()
    legend_below(
        figure,
        [
            Line2D([], [], color=GREY, marker="o", label="held to the tolerance"),
            Line2D([], [], color=GREY, marker="o", markerfacecolor="white", label="coarser mesh, or not held to any"),
            Line2D([], [], color=GREY, linestyle="--", label="tolerance"),
        ],
        CAPTION if any(_has_own_tolerances(own) for _, own in shown.groupby("case")) else "",
    )
    return figure


def _tolerances(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows whose error, not an order, is held to a tolerance."""
    return rows[rows["tolerance"].notna() & ~rows["quantity"].str.startswith(ORDER_OF)]


def _has_own_tolerances(rows: pd.DataFrame) -> bool:
    """Whether quantities of one case are held to several tolerances, or some of them to none."""
    held = _tolerances(rows)
    every = rows.loc[~rows["quantity"].str.startswith(ORDER_OF), "quantity"]
    return bool(held["tolerance"].nunique() > 1 or 0 < held["quantity"].nunique() < every.nunique())


def _panel(axes: Axes, rows: pd.DataFrame) -> None:
    """Errors of one case."""
    ordered = rows[rows["quantity"].str.startswith(ORDER_OF)]
    order = {row.quantity.removeprefix(ORDER_OF): row.computed for row in ordered.itertuples()}
    curves = rows.drop(ordered.index)
    tolerances, own_tolerances = _tolerances(rows)["tolerance"].unique(), _has_own_tolerances(rows)
    count = curves["quantity"].nunique()
    for number, (quantity, curve) in enumerate(curves.groupby("quantity", sort=False)):
        label = _typeset(str(quantity))
        label += f": order {order[quantity]:.2f}" if quantity in order else ""
        look: dict[str, Any] = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)]}
        look["markersize"] = BASE_SIZE + LARGER * (count - 1 - number)
        asked = curve["tolerance"].notna()
        axes.plot(curve["spacing"], curve["error"], markerfacecolor="white", label=label, **look)
        axes.plot(curve.loc[asked, "spacing"], curve.loc[asked, "error"], linestyle="none", **look)
        if own_tolerances and asked.any():
            axes.axhline(curve.loc[asked, "tolerance"].iloc[0], color=look["color"], linestyle="--", zorder=0)
    if len(tolerances) == 1 and not own_tolerances:
        axes.axhline(tolerances[0], color=GREY, linestyle="--", zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="Element length (mm)", ylabel="Relative error")
    every = pd.concat([curves["error"], curves["tolerance"].dropna()])
    columns = 1 if count <= LABELS else 2
    below = LABEL_HEIGHT * np.ceil(count / columns) + MARGIN  # where the legend stands
    decades = np.log10(every.max() / every.min()) / (1.0 - below - MARGIN)
    axes.set_ylim(every.min() / 10.0 ** (decades * below), every.max() * 10.0 ** (decades * MARGIN))
    spacings = sorted(curves["spacing"].unique())
    axes.set_xticks(spacings, [f"{spacing:.3g}" for spacing in spacings])
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.minorticks_off()
    axes.margins(x=0.15)
    axes.legend(loc="lower left", ncols=columns, handlelength=1.6, borderaxespad=0.0)


def _typeset(name: str) -> str:
    """A name with the Greek letters that it spells out, and laws as they are written."""
    for plain, typeset in TYPESET.items():
        name = name.replace(plain, typeset)
    return name
