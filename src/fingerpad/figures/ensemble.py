"""Which statements hold in every member of the ensemble over assumptions."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..ensemble.alternatives import AS_CONFIGURED, FIRST, SECOND
from ..ensemble.effect import with_effect, without_solution
from ..perception.statements import Kind
from ..perception.verdicts import Holds
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME, plain
from .style import BLACK, GREY, VERMILLION, WIDE, legend_below, new_figure, note_in, styled

ROW_HEIGHT, LETTER, LEGEND_HEIGHT = 3.1, 1.35, 30.0  # mm: of a member, of a letter of a statement, of title and legend
CLAIM_WIDTH = 54  # characters in a line of a statement, of which two fit a column
ASIDE = {FIRST: -0.2, SECOND: 0.2}  # of a statement's place [1], where a member's half-cycles are drawn
SIZE, EDGE, BETWEEN = 3.0, 0.7, 0.4  # pt: a mark, its edge, the lines between statements and groups
TIMES = "\N{MULTIPLICATION SIGN}"
MARKS: dict[Holds, dict[str, Any]] = {
    Holds.YES: {"marker": "o", "color": BLACK, "fillstyle": "full"},
    Holds.NO: {"marker": "x", "color": VERMILLION},
    Holds.UNDECIDED: {"marker": "o", "color": GREY, "fillstyle": "none"},
}
NO_SOLUTION: dict[str, Any] = {"marker": "_", "color": GREY, "label": "no solution"}
LOOK: dict[str, Any] = {"linestyle": "none", "markersize": SIZE, "markeredgewidth": EDGE}
NO_STATEMENT = "no statement: these are about the paper's devices"
# What members vary, by the first part of its key; members of a group stand together, in this order
GROUPS = {
    "finger": "finger",
    "tissue": "finger",
    "contact": "contact",
    "readout": "read-out",
    "filter": "read-out",
    "actuators": "device",
    "stimulus": "device",
}
GROUP_NAMES = list(dict.fromkeys(GROUPS.values()))
LAYERS_OF = "pad."  # a part of keys that the names of its layers say as well
CAPTION = (
    "n = {count} members: in each one assumption is varied, as named beside its marks, or none (lengths in mm, moduli"
    f" in MPa; {TIMES}: times the configured value). Left mark of a pair: first half-cycle of the stimulus, right:"
    " second. No mark: the numbers behind the statement do not change. (weaker): asks less than the paper says."
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
    rows = _rows(members)
    told = _told(claims, statements)
    lines = max(len(line) for text in told for line in text.splitlines())
    figure = new_figure(WIDE, ROW_HEIGHT * len(rows) + LETTER * lines + LEGEND_HEIGHT)
    axes = figure.subplots()
    _marks(axes, shown, lost, statements, rows)
    figure.suptitle(KINEMATICS_NAME[Kinematics(kinematics)].capitalize(), fontweight="bold")
    axes.xaxis.tick_top()
    axes.set_xticks(range(len(statements)), told, rotation=90, multialignment="left", linespacing=1.0)
    axes.set_yticks(range(len(rows)), [each if each in GROUP_NAMES else in_words(each) for each in rows])
    for label, each in zip(axes.get_yticklabels(), rows, strict=True):
        label.set_fontweight("bold" if each in GROUP_NAMES else "normal")
    handles = [Line2D([], [], label=str(each), **LOOK, **MARKS[each]) for each in Holds]
    handles += [] if lost.empty else [Line2D([], [], **LOOK, **NO_SOLUTION)]
    legend_below(figure, handles, CAPTION.format(count=len(members)))
    return figure


def in_words(member: str) -> str:
    """What a member varies, without the first part of its key, which is its group.

    >>> in_words("finger.pad.dermis.modulus 0.5"), in_words("contact.friction_from stimulus")
    ('dermis modulus 0.5', 'friction from stimulus')
    """
    key, _, value = member.partition(" ")
    if "." not in key:
        return member
    plainly = plain(key.partition(".")[2].removeprefix(LAYERS_OF)).replace(".", " ")
    return f"{plainly} {value.replace('times', TIMES)}"


def _group(member: str) -> str:
    """The group that a member belongs to; nothing of what is as configured."""
    part = member.partition(".")[0]
    return "" if member == AS_CONFIGURED else GROUPS.get(part, plain(part))


def _rows(members: Sequence[str]) -> list[str]:
    """Members from the top down, those of a group under its name."""
    groups = {name: [each for each in members if _group(each) == name] for name in ["", *GROUP_NAMES]}
    named = {each for own in groups.values() for each in own}
    others = [each for each in members if each not in named]
    return [each for name, own in groups.items() if own for each in ([name] if name else []) + own] + others


def _told(claims: pd.DataFrame, statements: Sequence[str]) -> list[str]:
    """Statements in lines, and which of them are weaker."""
    weaker = set(claims.loc[claims["kind"] == Kind.WEAKER, "claim"])
    return ["\n".join(wrap(f"{each} (weaker)" if each in weaker else each, CLAIM_WIDTH)) for each in statements]


def _marks(
    axes: Axes, claims: pd.DataFrame, lost: pd.DataFrame, statements: Sequence[str], rows: Sequence[str]
) -> None:
    """Marks: statements from the left, rows from the top down. lost: what has no solution."""
    looks = [(claims[claims["holds"] == str(holds)], look) for holds, look in MARKS.items()]
    for own, look in (*looks, (lost, NO_SOLUTION)):
        place = own["claim"].map(statements.index) + own["half_cycle"].map(ASIDE)
        axes.plot(place, own["varied"].map(rows.index), **LOOK, **look)
    axes.set_xlim(-0.5, len(statements) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    for between in range(1, len(statements)):
        axes.axvline(between - 0.5, color=GREY, linewidth=BETWEEN)
    for number, each in enumerate(rows):
        if each in GROUP_NAMES:
            axes.axhline(number - 0.5, color=GREY, linewidth=BETWEEN)
    axes.tick_params(length=0.0)
    axes.spines[["left", "bottom"]].set_visible(False)
