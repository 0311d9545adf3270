"""Which statements hold in every member of the ensemble over assumptions."""

from __future__ import annotations

from textwrap import wrap
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..ensemble.alternatives import FIRST, SECOND
from ..ensemble.effect import with_effect, without_solution
from ..perception.statements import Kind
from ..perception.verdicts import Holds
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME
from .style import BLUE, GREY, VERMILLION, WIDE, legend_below, new_figure, note_in, styled, subtitle

ROW_HEIGHT, LETTER, LEGEND_HEIGHT = 6.6, 1.35, 30.0  # mm: of a statement, of a letter of a name, of title and legend
CLAIM_WIDTH = 54  # characters in a line of a statement
ASIDE = {FIRST: -0.22, SECOND: 0.22}  # of a member's place [1], where its half-cycles are drawn
SIZE, EDGE, BETWEEN = 2.4, 0.6, 0.4  # pt: a mark, its edge, the lines between members
MARKS: dict[Holds, dict[str, Any]] = {
    Holds.YES: {"marker": "o", "color": BLUE, "fillstyle": "full"},
    Holds.NO: {"marker": "x", "color": VERMILLION},
    Holds.UNDECIDED: {"marker": "o", "color": GREY, "fillstyle": "none"},
}
NO_SOLUTION: dict[str, Any] = {"marker": "_", "color": GREY, "label": "no solution"}
LOOK: dict[str, Any] = {"linestyle": "none", "markersize": SIZE, "markeredgewidth": EDGE}
NO_STATEMENT = "no statement: these are about the paper's devices"
CAPTION = (
    "n = {count} members: in each one assumption is varied, as named under its marks, or none (lengths in mm, moduli in"
    " MPa). Left mark of a pair: first half-cycle of the stimulus, right: second. No mark: the numbers behind the"
    " statement do not change. (weaker):"
    " asks less than the paper says."
    " Ratings: ordinal surrogates where data/ratings.csv calls them so."
)


@styled
def ensemble_figure(claims: pd.DataFrame) -> Figure:
    """A mark for every statement, member and half-cycle whose numbers are not those as configured, or that has no
    solution; a note where no statement is about the devices.

    claims: rows of results/ensemble_claims.csv with one kinematics.
    """
    if claims.empty:
        figure = new_figure(WIDE, LEGEND_HEIGHT)
        note_in(figure.subplots(), NO_STATEMENT)
        return figure
    (kinematics,) = claims["kinematics"].unique()
    groups = claims.groupby(["claim", "half_cycle"], sort=False)
    shown = pd.concat([with_effect(own, "evidence") for _, own in groups])
    lost = without_solution(claims)
    statements = list(claims["claim"].unique())
    members = [each for each in claims["varied"].unique() if each in {*shown["varied"], *lost["varied"]}]
    height = ROW_HEIGHT * len(statements) + LETTER * max(map(len, members)) + LEGEND_HEIGHT
    figure = new_figure(WIDE, height)
    axes = figure.subplots()
    _marks(axes, shown, lost, statements, members)
    subtitle(axes, KINEMATICS_NAME[Kinematics(kinematics)].capitalize(), "")
    axes.set_xticks(range(len(members)), members, rotation=90)
    handles = [Line2D([], [], label=str(each), **LOOK, **MARKS[each]) for each in Holds]
    handles += [] if lost.empty else [Line2D([], [], **LOOK, **NO_SOLUTION)]
    legend_below(figure, handles, CAPTION.format(count=len(members)))
    return figure


def _marks(axes: Axes, claims: pd.DataFrame, lost: pd.DataFrame, statements: list[str], members: list[str]) -> None:
    """Marks: statements from the top down, members from the left. lost: what has no solution."""
    looks = [(claims[claims["holds"] == str(holds)], look) for holds, look in MARKS.items()]
    for own, look in (*looks, (lost, NO_SOLUTION)):
        place = own["varied"].map(members.index) + own["half_cycle"].map(ASIDE)
        axes.plot(place, own["claim"].map(statements.index), **LOOK, **look)
    weaker = set(claims.loc[claims["kind"] == Kind.WEAKER, "claim"])
    told = [f"{each} (weaker)" if each in weaker else each for each in statements]
    axes.set_yticks(range(len(statements)), ["\n".join(wrap(each, CLAIM_WIDTH)) for each in told])
    axes.set_xlim(-0.5, len(members) - 0.5)
    axes.set_ylim(len(statements) - 0.5, -0.5)
    for between in range(1, len(members)):
        axes.axvline(between - 0.5, color=GREY, linewidth=BETWEEN)
    axes.tick_params(length=0.0)
