"""Other scorings: another filter, sign or area, the pre-indented state alone, and the drive alone, without a model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from enum import StrEnum
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.readout import Readout
from ..scene.scene import Scene
from .accuracy import score_key, with_error
from .gabor import FilteredReadouts, gabor_filtered
from .roughness import SCORE_UNIT, over_span, roughness_score, scene_span, score_row


class Scoring(StrEnum):
    """From receptors, or from the drive alone, to a score."""

    CONFIGURED = "as configured"
    UNFILTERED = "no filter"
    EXCHANGED = "filters exchanged"
    MAGNITUDE = "magnitude of the change"
    SIGNED = "signed area"
    INDENTED = "pre-indented state alone"
    RELATIVE = "no finger: relative motion"
    COMMON = "no finger: common motion"
    MOTION = "no finger: both motions"


DRIVES = (Scoring.RELATIVE, Scoring.COMMON, Scoring.MOTION)
UNITS = dict.fromkeys((Scoring.UNFILTERED, *DRIVES), "mm")  # of those that are no area of a filtered curve


def relative_motion(condition: Condition) -> float:
    """Way [mm] between neighbours: sum over neighbours of |u_i - u_(i+1)|, at the time at which it is largest."""
    return float(np.linalg.norm(np.diff(condition.moves, axis=1), axis=2).sum(axis=1).max())


def common_motion(condition: Condition) -> float:
    """Way [mm] of the row as a whole: |mean of u_i|, at the time at which it is largest."""
    return float(np.linalg.norm(condition.moves.mean(axis=1), axis=1).max())


def both_motions(condition: Condition) -> float:
    """Relative and common motion together [mm]."""
    return relative_motion(condition) + common_motion(condition)


def other_scores(scene: Scene, condition: Condition, read: FilteredReadouts) -> dict[tuple[Scoring, Readout], float]:
    """Scores of one condition [mm2, or as UNITS says], by scoring and by the read-outs for which it says something else
    than the configured one.
    """
    strain, change = read.unfiltered(Readout.STRAIN), read.unfiltered(Readout.CHANGE_OF_STRAIN)
    span, gabor = scene_span(scene), scene.model.gabor

    def area(values: FloatArray) -> float:
        return roughness_score(read.arc, values, span)

    def through(values: FloatArray, readout: Readout) -> FloatArray:
        return gabor_filtered(read.arc, values, gabor.wavelength(readout), gabor.sigma)

    return {
        **{(Scoring.UNFILTERED, each): area(read.unfiltered(each)) for each in Readout},
        (Scoring.EXCHANGED, Readout.STRAIN): area(through(strain, Readout.CHANGE_OF_STRAIN)),
        (Scoring.EXCHANGED, Readout.CHANGE_OF_STRAIN): area(through(change, Readout.STRAIN)),
        (Scoring.MAGNITUDE, Readout.CHANGE_OF_STRAIN): area(through(np.abs(change), Readout.CHANGE_OF_STRAIN)),
        **{(Scoring.SIGNED, each): _signed(read.arc, read.filtered(each), span) for each in Readout},
        (Scoring.INDENTED, Readout.STRAIN): area(through(strain - change, Readout.STRAIN)),
        (Scoring.RELATIVE, Readout.CHANGE_OF_STRAIN): relative_motion(condition),
        (Scoring.COMMON, Readout.CHANGE_OF_STRAIN): common_motion(condition),
        (Scoring.MOTION, Readout.CHANGE_OF_STRAIN): both_motions(condition),
    }


def _signed(grid: FloatArray, filtered: FloatArray, span: tuple[float, float]) -> float:
    """Area [mm2] under a curve that is not rectified."""
    points, values = over_span(grid, filtered, span)
    return float(np.trapezoid(values, points))


def scoring_rows(
    scene: Scene,
    condition: Condition,
    interface: Interface,
    read: FilteredReadouts,
    errors: Mapping[tuple[str, ...], float],
) -> Iterator[dict[str, Any]]:
    """Rows of the score table of one case behind `scoring`, for every scoring but the configured one.

    errors: relative ones of configured scores by case (`accuracy.relative_errors`) [1]. What is made of the same curves
    takes them, if they are known; the drive has none, and the error of a signed area is that of the rectified one.
    """
    for (scoring, readout), score in other_scores(scene, condition, read).items():
        row = score_row(scene, condition, interface, readout, score, "") | {"unit": UNITS.get(scoring, SCORE_UNIT)}
        share = 0.0 if scoring in DRIVES else errors.get(score_key(row))
        whole = roughness_score(read.arc, read.filtered(readout), scene_span(scene))
        error = None if share is None else share * (whole if scoring is Scoring.SIGNED else score)
        yield {"scoring": str(scoring)} | with_error(row, error)


def response(period: float, wavelength: float, sigma: float) -> float:
    """Amplitude [1] of what the Gabor filter leaves of a wave of that period [mm], over that which it leaves of its own
    wavelength [mm]: |G^(k)| / |G^(2 pi / wavelength)| with the Fourier transform of the kernel of width sigma [mm],
    G^(k) = sqrt(pi / 2) sigma (exp(-sigma^2 (k - k0)^2 / 2) + exp(-sigma^2 (k + k0)^2 / 2)), k0 = 2 pi / wavelength.

    >>> round(response(1.15, 1.15, 1.12), 12), response(5.0, 1.15, 1.12) < 1e-4
    (1.0, True)
    >>> round(response(math.inf, 2.8, 1.12), 3)
    0.085
    """
    own = 2.0 * np.pi / wavelength

    def transform(k: float) -> float:
        return float(sum(np.exp(-((sigma * (k + sign * own)) ** 2) / 2.0) for sign in (-1.0, 1.0)))

    return transform(2.0 * np.pi / period) / transform(own)


def response_rows(scene: Scene) -> list[dict[str, Any]]:
    """What each read-out's filter leaves of waves as long as a device's faces, its pitch and two pitches, and of what
    is everywhere the same: one row for each, with `period` [mm] and `response` [1].
    """
    row, gabor = scene.device.actuators, scene.model.gabor
    lengths = {"uniform": math.inf, "face width": row.width}
    if len(row.positions) > 1:
        pitch = float(np.diff(row.positions).mean())
        lengths |= {"pitch": pitch, "two pitches": 2.0 * pitch}
    return [
        {
            "device": scene.device.name,
            "readout": str(readout),
            "length": name,
            "period": period,
            "response": response(period, gabor.wavelength(readout), gabor.sigma),
        }
        for readout in Readout
        for name, period in lengths.items()
    ]
