"""What a design does to the skin, and how rough it feels, at a glance: made to be drawn anew at every change."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..design import Answer
from ..roughness import score_span
from ..scene import FloatArray, Readout
from .receptors import draw_faces, face_arcs
from .style import (
    BLUE,
    GREY,
    LINE,
    MM,
    PERCENT,
    READOUT_NAME,
    SCORE_SCALE,
    THIN,
    VERMILLION,
    WIDE,
    score_label,
    styled,
)

HEIGHT = 105.0  # mm
EDGES = {"left": 0.09, "right": 0.985, "bottom": 0.1, "top": 0.94, "wspace": 0.3, "hspace": 0.2}  # of the figure [1]
WIDTHS = (3.2, 1.0)  # of the columns, relative
KILO = 1e3  # kPa in a MPa
HEADROOM = 1.25  # of the scores' axis beyond the larger [1]
NOTE = (0.79, 0.93)  # where the note stands, of the figure [1]
TICKS = 3  # intervals of a vertical axis at most [1]
BEFORE, NOW = 0.0, 1.0  # places of both scores [1]


@styled
def design_figure(answer: Answer, before: Answer | None = None) -> Figure:
    """Contact tractions, strain and change of strain at the receptors, and both scores with their errors.

    before: the answer of an earlier design, in grey beside the new one.
    """
    # laid out by hand: a layout engine would take longer than the solution
    figure = Figure(figsize=(WIDE * MM, HEIGHT * MM))
    places = figure.add_gridspec(1 + len(Readout), 2, width_ratios=WIDTHS, **EDGES)
    left = [figure.add_subplot(places[line, 0]) for line in range(1 + len(Readout))]
    right = [figure.add_subplot(places[1 + line, 1]) for line in range(len(Readout))]
    span = score_span(answer.scene.device.actuators, answer.scene.model.readout.span_margin)
    for axes in left:
        axes.set_xlim(*span)
    if before:
        _draw_tractions(left[0], before, (GREY, GREY))
    _draw_tractions(left[0], answer, (BLUE, VERMILLION))
    left[0].set_ylabel("Traction (kPa)")
    left[0].legend(
        handles=[
            Line2D([], [], color=BLUE, label="pressure"),
            Line2D([], [], color=VERMILLION, label="shear"),
            *([Line2D([], [], color=GREY, label="before")] if before else []),
        ],
        loc="lower left", bbox_to_anchor=(0.0, 0.98), ncols=3, borderaxespad=0.0,
    )  # fmt: skip
    for axes, bars, readout in zip(left[1:], right, Readout, strict=True):
        draw_faces(axes, face_arcs(answer.scene.device, answer.section))
        if before:
            axes.plot(before.readouts.arc, PERCENT * _read(before, readout), color=GREY)
        axes.plot(answer.readouts.arc, PERCENT * _read(answer, readout), color=BLUE)
        axes.set_ylabel(f"{READOUT_NAME[readout]} (%)")
        _draw_scores(bars, readout, answer, before)
    left[1].set_ylim(bottom=0.0)
    for axes in (*left[:-1], *right[:-1]):  # ticks take most of the time, and those at the bottom hold for all
        axes.set_xticks([])
    for axes in (*left, *right):
        axes.locator_params(axis="y", nbins=TICKS)
    indentation, nodes = answer.solution.indentation, np.count_nonzero(answer.solution.status)
    figure.text(*NOTE, f"indentation {indentation:.2f} mm\n{nodes} nodes in contact", color=GREY, va="top")
    left[-1].set_xlabel("x on the skin, arc length along the receptor line (mm)")
    return figure


def _read(answer: Answer, readout: Readout) -> FloatArray:
    """A read-out (k,) [1] on the uniform grid."""
    return answer.readouts.strain if readout is Readout.STRAIN else answer.readouts.change_of_strain


def _draw_tractions(axes: Axes, answer: Answer, colours: tuple[str, str]) -> None:
    """Pressure and shear where the skin now is."""
    solution, positions = answer.solution, np.asarray(answer.scene.device.actuators.positions)
    (condition,) = answer.scene.device.conditions
    nearest = np.argmin(np.abs(answer.section.position[:, [0]] - positions), axis=1)
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    for number, centre in enumerate(positions + condition.tangential[-1]):
        touched = (nearest == number) & (solution.pressure > 0.0)
        x = centre + solution.place[touched]
        for values, colour in zip((solution.pressure, solution.shear), colours, strict=True):
            axes.plot(x, KILO * values[touched], color=colour)


def _draw_scores(axes: Axes, readout: Readout, answer: Answer, before: Answer | None) -> None:
    """The score with its error, beside that of the design before."""
    factor, _ = SCORE_SCALE[readout]
    highest = 0.0
    for place, each, colour in ((BEFORE, before, GREY), (NOW, answer, BLUE)):
        if each is None:
            continue
        (found,) = (row for row in each.rows if row["readout"] == readout)
        score, error = factor * found["score"], factor * found["score_error"]
        axes.bar(place, score, color=colour, width=0.7)
        axes.vlines(place, score - error, score + error, color="black", linewidth=LINE)
        axes.text(place, score + error, f"{score:.3g}\n±{error:.1g}", ha="center", va="bottom")
        highest = max(highest, score + error)
    axes.set(xlim=(-0.6, 1.6), ylim=(0.0, HEADROOM * highest))
    axes.set_xticks([BEFORE, NOW], ["before", "now"])
    axes.set_ylabel(score_label(readout, answer.rows[0]["unit"]).replace(" score", "\nscore"))
