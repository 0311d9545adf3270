"""What a design does to the skin, and how rough it feels, at a glance: laid out once, drawn again at every change."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from math import isnan, nan
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon, Rectangle
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator
from PIL import Image

from ..arrays import FloatArray
from ..contact.formulation import Status
from ..prediction.design import Answer
from ..readouts.roughness import SCORE_UNIT, scene_span
from ..rounding import rounded
from ..scene.readout import Readout
from ..words import KILO, PERCENT, READOUT_NAME, SCORE_SCALE, score_label
from .receptors import face_arcs
from .style import ALONG, DASHED, GREEN, GREY, INTO, INTO_EDGE, LINE, MM, SHADE, THIN, WIDE, styled

HEIGHT = 105.0  # mm
RESOLUTION = 110.0  # of the picture [dots per inch]
EDGES = {"left": 0.09, "right": 0.985, "bottom": 0.1, "top": 0.94, "wspace": 0.3, "hspace": 0.2}  # of the figure [1]
WIDTHS = (3.2, 1.0)  # of the columns, relative
HEADROOM = 1.25  # of the scores' axis beyond the larger [1]
BAR = 0.7  # width of a score's bar, of the distance between both [1]
NOTE = (0.79, 0.93)  # where the note stands, of the figure [1]
LOCATOR = MaxNLocator(4, steps=[1.0, 2.0, 2.5, 5.0, 10.0])  # of vertical axes: intervals at most, and their lengths [1]
PLACES = {"before": 0.0, "now": 1.0}  # of both scores [1]
SLIGHT = 0.01  # of a vertical axis [1] below zero that is not shown; source: splines undershoot by less
PNG_LEVEL = 1  # of 9; source: fewest seconds (measured), for a picture that is read where it is made


@dataclass(frozen=True)
class _Design:
    """The artists that show one design: tractions, and by read-out curve, score, its error and its number. area: under
    the pressure, without a fill where only its edge is shown.
    """

    area: Polygon
    pressure: Line2D
    shear: Line2D
    curves: dict[Readout, Line2D]
    bars: dict[Readout, Rectangle]
    errors: dict[Readout, Line2D]
    numbers: dict[Readout, Text]

    def artists(self) -> list[Artist]:
        """All of them, the lowest first."""
        by_readout = (self.curves, self.bars, self.errors, self.numbers)
        return [self.area, self.pressure, self.shear, *(artist for group in by_readout for artist in group.values())]


class DesignPicture:
    """Contact tractions, strain and change of strain at the receptors, and both scores with their errors.

    Axes and artists are made once, and drawn onto a background that is kept while no axis changes: to make them takes
    longer than to draw them, and to draw axes and their ticks longer than the solution.
    """

    @styled
    def __init__(self, pins: int) -> None:
        """An empty picture for rows of so many pins."""
        # laid out by hand: a layout engine would take longer than the solution
        self.figure = Figure(figsize=(WIDE * MM, HEIGHT * MM), dpi=RESOLUTION)
        self._canvas: Any = FigureCanvasAgg(self.figure)
        places = self.figure.add_gridspec(1 + len(Readout), 2, width_ratios=WIDTHS, **EDGES)
        self._tractions = self.figure.add_subplot(places[0, 0])
        self._strains = {each: self.figure.add_subplot(places[1 + n, 0]) for n, each in enumerate(Readout)}
        self._scores = {each: self.figure.add_subplot(places[1 + n, 1]) for n, each in enumerate(Readout)}
        self._faces = [
            axes.axvspan(0.0, 0.0, color=SHADE, linewidth=0.0, zorder=0)
            for axes in self._strains.values()
            for _ in range(pins)
        ]
        self._label_axes()
        self._before = self._design("before", ("none", GREY, GREY, GREY), THIN, DASHED)
        self._now = self._design("now", (INTO, INTO_EDGE, ALONG, GREEN), LINE, "-")
        self._note = self.figure.text(*NOTE, "", color=GREY, va="top")
        self._moving = [*self._faces, *self._before.artists(), *self._now.artists(), self._note]
        for artist in self._moving:
            artist.set_animated(True)
        self._limits: tuple[float, ...] = ()
        self._background: Any = None

    def _label_axes(self) -> None:
        """What stays: names, units, ticks, legend."""
        self._tractions.axhline(0.0, color=GREY, linewidth=THIN)
        self._tractions.set_ylabel("Traction (kPa)")
        self._tractions.legend(
            handles=[
                Patch(facecolor=INTO, edgecolor=INTO_EDGE, label="pressure"),
                Line2D([], [], color=ALONG, label="shear"),
                Line2D([], [], color=GREY, linewidth=THIN, label="previous design"),
                Line2D([], [], color=GREY, linewidth=THIN, linestyle=DASHED, label="its shear"),
            ],
            loc="lower left", bbox_to_anchor=(0.0, 0.98), ncols=4, borderaxespad=0.0,
        )  # fmt: skip
        for readout in Readout:
            self._strains[readout].set_ylabel(f"{READOUT_NAME[readout]} (%)")
            self._scores[readout].set_ylabel(score_label(readout, SCORE_UNIT, in_two_lines=True))
            self._scores[readout].set_xlim(-0.6, 1.6)
        left, right = [self._tractions, *self._strains.values()], list(self._scores.values())
        for axes in (*left[:-1], *right[:-1]):  # ticks take most of the time, and those at the bottom hold for all
            axes.set_xticks([])
        right[-1].set_xticks(list(PLACES.values()), list(PLACES))
        left[-1].set_xlabel("x on the skin, arc length along the receptor line (mm)")

    def _design(self, name: str, colours: tuple[str, str, str, str], width: float, line: Any) -> _Design:
        """Artists without data, in the colours of the area under the pressure, its edge, shear and read-outs; width: of
        lines [pt], which tells designs apart where colours do not. line: style of shear.
        """
        (area, pressure, shear, read), place = colours, PLACES[name]
        return _Design(
            area=self._tractions.fill([], [], color=area, linewidth=0.0)[0],
            pressure=self._tractions.plot([], [], color=pressure, linewidth=width)[0],
            shear=self._tractions.plot([], [], color=shear, linewidth=width, linestyle=line)[0],
            curves={each: axes.plot([], [], color=read, linewidth=width)[0] for each, axes in self._strains.items()},
            bars={each: axes.bar(place, 0.0, color=read, width=BAR)[0] for each, axes in self._scores.items()},
            errors={each: axes.plot([], [], color="black", linewidth=LINE)[0] for each, axes in self._scores.items()},
            numbers={each: axes.text(place, 0.0, "", ha="center", va="bottom") for each, axes in self._scores.items()},
        )

    @styled
    def show(self, answer: Answer, before: Answer | None = None) -> None:
        """Draw a design, beside that of an earlier answer in grey."""
        designs = [(self._now, PLACES["now"], answer), *([(self._before, PLACES["before"], before)] if before else [])]
        for artists, place, each in designs:
            _set(artists, place, each)
        faces = face_arcs(answer.scene.device, answer.section, answer.solution)
        for artist, (start, stop) in zip(self._faces, np.tile(faces, (len(Readout), 1)), strict=True):
            artist.set(x=start, width=stop - start)
        indentation, nodes = answer.solution.indentation, np.count_nonzero(answer.solution.status != Status.OPEN)
        self._note.set_text(f"indentation {indentation:.2f} mm\n{nodes} nodes in contact")
        for axes in (self._tractions, *self._strains.values()):
            axes.set_xlim(*scene_span(answer.scene))
        shown = [artists for artists, _, _ in designs]
        _hold(self._tractions, [line for each in shown for line in (each.pressure, each.shear)])
        for readout in Readout:
            _hold(self._strains[readout], [each.curves[readout] for each in shown])
            _hold(self._scores[readout], [each.errors[readout] for each in shown], HEADROOM)
        self._draw()

    def _draw(self) -> None:
        """Draw what moves; axes only if one has changed."""
        limits = tuple(limit for axes in self.figure.axes for limit in (*axes.get_xlim(), *axes.get_ylim()))
        if limits == self._limits:
            self._canvas.restore_region(self._background)
        else:
            self._canvas.draw()
            self._background, self._limits = self._canvas.copy_from_bbox(self.figure.bbox), limits
        for artist in self._moving:
            self.figure.draw_artist(artist)

    def png(self) -> bytes:
        """What is drawn, as a PNG file."""
        file = BytesIO()
        opaque = np.asarray(self._canvas.buffer_rgba())[..., :3]
        Image.fromarray(np.ascontiguousarray(opaque)).save(file, "png", compress_level=PNG_LEVEL)
        return file.getvalue()


def _set(artists: _Design, place: float, answer: Answer) -> None:
    """Give a design's artists its data; its scores stand at `place`."""
    x, pressure, shear = _tractions(answer)
    parts = np.split(np.stack([x, pressure], axis=1), np.flatnonzero(np.isnan(x)))
    artists.area.set_xy(np.concatenate([_down_to_zero(part[np.isfinite(part[:, 0])]) for part in parts]))
    artists.pressure.set_data(x, pressure)
    artists.shear.set_data(x, shear)
    for readout, row in zip(Readout, answer.rows, strict=True):
        factor, _ = SCORE_SCALE[readout]
        score, stated = factor * row["score"], nan if row["score_error"] is None else factor * row["score_error"]
        error = 0.0 if isnan(stated) else stated
        artists.curves[readout].set_data(answer.readouts.arc, PERCENT * answer.readouts.unfiltered(readout))
        artists.bars[readout].set_height(score)
        artists.errors[readout].set_data([place, place], [score - error, score + error])
        artists.numbers[readout].set(position=(place, score + error), text="\n±".join(rounded(score, stated)))


def _down_to_zero(curve: FloatArray) -> FloatArray:
    """A curve (n, 2), which begins and ends at zero."""
    return np.insert(curve, [0, len(curve)], [[curve[0, 0], 0.0], [curve[-1, 0], 0.0]], axis=0)


def _tractions(answer: Answer) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Where the skin in contact now is [mm], pressure and shear there [kPa]; a gap of NaN between pins."""
    solution, row = answer.solution, answer.scene.device.actuators
    (condition,) = answer.scene.device.conditions
    x = solution.skin_x(row, condition)
    touched = np.flatnonzero(solution.pressure > 0.0)
    found = np.stack([x, KILO * solution.pressure, KILO * solution.shear])[:, touched]
    return tuple(np.insert(found, np.flatnonzero(np.diff(solution.actuator[touched])) + 1, np.nan, axis=1))


def _hold(axes: Axes, lines: list[Line2D], headroom: float = 1.0) -> None:
    """End a vertical axis at ticks beyond zero and all that lines show on it, so that it often stays as it is."""
    start, stop = axes.get_xlim()
    x, y = np.hstack([np.asarray(line.get_data(), dtype=float) for line in lines])
    shown = y[(x >= start) & (x <= stop)]
    low, high = min(0.0, float(np.nanmin(shown))), headroom * float(np.nanmax(shown))
    low = low if -low > SLIGHT * high else 0.0
    ticks = np.asarray(LOCATOR.tick_values(low, high))
    ticks = ticks[np.searchsorted(ticks, low, "right") - 1 : np.searchsorted(ticks, high) + 1]
    if axes.get_ylim() != (ticks[0], ticks[-1]):
        axes.set_yticks(ticks)
        axes.set_ylim(ticks[0], ticks[-1])
