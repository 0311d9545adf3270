"""Roughness score: area under the rectified, filtered read-out over the actuator row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np

from ..arrays import FloatArray
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.readout import Readout
from ..scene.scene import Scene
from .gabor import FilteredReadouts

Row = TypeVar("Row", bound=Mapping[str, Any])  # of the score table

SCORE_UNIT = "mm2"  # strain [1] filtered along x [mm], integrated along x [mm]
# columns of the score table: all; those that tell series of scores apart; those that tell each row from all others
SCORE_COLUMNS = [
    *("kinematics", "device", "condition", "dispersion", "phase_deg", "interface", "readout"),
    *("score", "score_error", "unit", "note"),
]
SERIES = ["kinematics", "device", "interface", "readout"]
SCORE_KEY = ["kinematics", "device", "condition", "interface", "readout"]
NO_PREDICTION = "no prediction"


def scene_span(scene: Scene) -> tuple[float, float]:
    """Span (start, stop) [mm] of a scene's scores: x of the row's outer edges and a margin beyond, as arc lengths."""
    # ASSUME: readout.span_margin is laid off from x of the row's ends as if that were arc length (docs/model.md, 10)
    row, margin = scene.device.actuators, scene.model.readout.span_margin
    start, stop = row.span
    return start - margin, stop + margin


def roughness_score(grid: FloatArray, filtered: FloatArray, span: tuple[float, float]) -> float:
    """Area [mm2] of |G * e| over the span: the trapezoidal integral of |filtered| ds.

    Rectified, as the signed area of the RA-1 filter's output all but vanishes; that of the SA-1 filter's does not
    (decision 37). grid: (k,) [mm], filtered: (k,) [mm]. Where the span goes beyond
    the grid there are no receptors, and nothing is added.

    >>> grid = np.linspace(-2.0, 2.0, 401)
    >>> round(roughness_score(grid, -np.ones(401), (-1.0, 1.0)), 12)
    2.0
    """
    # ASSUME: readout: the area under the curve is that of the rectified one (docs/scorings.md)
    points, values = over_span(grid, filtered, span)
    return float(np.trapezoid(np.abs(values), points))


def over_span(grid: FloatArray, values: FloatArray, span: tuple[float, float]) -> tuple[FloatArray, FloatArray]:
    """Points (p,) [mm] of the grid (k,) within a span, and its ends; and the values (p,) there."""
    start, stop = np.clip(span, grid[0], grid[-1])
    inside = grid[(grid > start) & (grid < stop)]
    points = np.concatenate([[start], inside, [stop]])
    return points, np.interp(points, grid, values)


def roughness_scores(scene: Scene, readouts: FilteredReadouts) -> dict[Readout, float]:
    """Scores [mm2] of both filtered read-outs over a scene's row."""
    return {each: roughness_score(readouts.arc, readouts.filtered(each), scene_span(scene)) for each in Readout}


def score_rows(
    scene: Scene, condition: Condition, interface: Interface, readouts: FilteredReadouts, note: str = ""
) -> list[dict[str, Any]]:
    """Rows of the score table for one condition and interface: one a read-out. note: what to beware of."""
    scores = roughness_scores(scene, readouts)
    return [score_row(scene, condition, interface, readout, score, note) for readout, score in scores.items()]


def unpredicted_rows(scene: Scene) -> list[dict[str, Any]]:
    """Rows, with no score, for the interfaces left out: motion is not prescribed there, or the file says so."""
    silent = [interface for interface in Interface if interface not in scene.device.interfaces()]
    return [
        row
        for condition in scene.device.conditions
        for interface in silent
        for row in unscored_rows(scene, condition, interface, NO_PREDICTION)
    ]


def unscored_rows(scene: Scene, condition: Condition, interface: Interface, note: str) -> list[dict[str, Any]]:
    """Rows, with no score but a note, for one condition and interface: one a read-out."""
    return [score_row(scene, condition, interface, readout, None, note) for readout in Readout]


def rows_of(rows: Iterable[Row], interface: Interface, readout: Readout) -> list[Row]:
    """Those rows of the score table that are of one interface and read-out."""
    return [row for row in rows if (row["interface"], row["readout"]) == (interface, readout)]


def score_row(
    scene: Scene, condition: Condition, interface: Interface, readout: Readout, score: float | None, note: str
) -> dict[str, Any]:
    """One row of the score table, as long as it has no error."""
    return {
        "kinematics": str(scene.kinematics),
        "device": scene.device.name,
        "condition": condition.name,
        "dispersion": condition.dispersion,
        "phase_deg": condition.phase_deg,
        "interface": str(interface),
        "readout": str(readout),
        "score": score,
        "unit": SCORE_UNIT,
        "note": note,
    }
