"""Error of every closed form against the size of elements, with its tolerance."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from ..closedforms.comparison import ORDER_OF
from .style import COLOURS, GREY, MARKERS, WIDE, legend_below, letter, new_figure, styled

COLUMNS = 3
ROW_HEIGHT, LEGEND_HEIGHT = 42.0, 10.0  # mm
LETTER_OFFSET = (-26.0, 4.0)  # pt
DECADES = 2  # of error below the smallest, where the legend stands


@styled
def accuracy_figure(rows: pd.DataFrame) -> Figure:
    """One panel a case, one curve a quantity. rows: the table of closed forms."""
    cases = list(dict.fromkeys(rows["case"]))
    lines = -(-len(cases) // COLUMNS)
    figure = new_figure(WIDE, ROW_HEIGHT * lines + LEGEND_HEIGHT)
    grid = figure.subplots(lines, COLUMNS, squeeze=False).ravel()
    for axes, case, name in zip(grid, cases, "ABCDEFGHIJKLMNOPQRSTUVWXYZ", strict=False):
        _panel(axes, rows[rows["case"] == case])
        axes.set_title(case.replace("nu = ", "ν = ").replace("mu = ", "μ = "), loc="left")
        letter(axes, name, LETTER_OFFSET)
    for axes in grid[len(cases) :]:
        axes.set_axis_off()
    legend_below(
        figure,
        [
            Line2D([], [], color=GREY, marker="o", label="the tolerance holds here"),
            Line2D([], [], color=GREY, marker="o", markerfacecolor="white", label="no tolerance"),
            Line2D([], [], color=GREY, linestyle="--", label="tolerance"),
        ],
    )
    return figure


def _panel(axes: Axes, rows: pd.DataFrame) -> None:
    """Errors of one case."""
    ordered = rows[rows["quantity"].str.startswith(ORDER_OF)]
    order = {row.quantity.removeprefix(ORDER_OF): row.computed for row in ordered.itertuples()}
    curves = rows.drop(ordered.index)
    for number, (quantity, curve) in enumerate(curves.groupby("quantity", sort=False)):
        label = str(quantity).replace("nu = ", "ν = ")
        label += f": order {order[quantity]:.2f}" if quantity in order else ""
        look = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)]}
        asked = curve["tolerance"].notna()
        axes.plot(curve["spacing"], curve["error"], markerfacecolor="white", label=label, **look)
        axes.plot(curve.loc[asked, "spacing"], curve.loc[asked, "error"], linestyle="none", **look)
    for tolerance in curves["tolerance"].dropna().unique():
        axes.axhline(tolerance, color=GREY, linestyle="--", zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="Element length (mm)", ylabel="Relative error")
    lowest, highest = curves["error"].min(), max(curves["error"].max(), curves["tolerance"].max())
    axes.set_ylim(lowest / 10.0**DECADES, 3.0 * highest)
    axes.set_xticks(sorted(curves["spacing"].unique()), [f"{h:.2g}" for h in sorted(curves["spacing"].unique())])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.margins(x=0.15)
    axes.legend(loc="lower left", handlelength=1.6, borderaxespad=0.0)
