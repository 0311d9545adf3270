"""Receptor read-outs: maximum principal strain (SA-1 proxy) and its change from pre-indentation (RA-1 proxy)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..scene.readout import Readout
from ..tissue.compliance import VOIGT
from .comparison import CONSTANT

# Change at another time over that which is read [1], from which on people may answer the other; source: assumption:
# nobody tells a twentieth apart; between the shipped mesh and halves of it this moves by 0.007 (eight patterns of pins)
RIVAL = 0.95
# Least relative difference [1] at which two changes count as different patterns; source: a pattern that swells and
# fades and is as large as its peak but for RIVAL differs from it by half of that
UNLIKE = 0.1
# Relative difference [1] up to which changes count as equally large; source: those at times that mirror differ by 1e-11
TIED = 1e-6


def maximum_principal(components: FloatArray) -> FloatArray:
    """Largest of the three principal strains (m,) [1] in plane strain, from (3m,) exx, eyy, gxy point by point.

    The in-plane pair is (exx + eyy)/2 +- sqrt(((exx - eyy)/2)^2 + (gxy/2)^2); the third, out of the plane, is zero.

    >>> maximum_principal(np.array([0.01, -0.02, 0.0, -0.01, -0.01, 0.0])).round(12).tolist()
    [0.01, 0.0]
    """
    exx, eyy, gxy = components.reshape(-1, VOIGT).T
    in_plane = (exx + eyy) / 2.0 + np.hypot((exx - eyy) / 2.0, gxy / 2.0)
    return np.maximum(in_plane, 0.0)


@dataclass(frozen=True)
class Reading:
    """What receptors say of a stimulus: both read-outs at one of its times, in the unit of a measure.

    time: index of that time. strain, change_of_strain: (m,). rival: index of the time whose change differs most from
    that which is read, of those at which it is as large but for RIVAL and another pattern; the one that is read if
    there is none. rival_change: (m,) the change then. rival_peak: how large that is over the one which is read [1]:
    root mean squares over arc length.
    """

    time: int
    strain: FloatArray
    change_of_strain: FloatArray
    rival: int
    rival_change: FloatArray
    rival_peak: float

    @property
    def rivalled(self) -> bool:
        """Whether there is such a time."""
        return self.rival != self.time

    @property
    def readouts(self) -> dict[Readout, FloatArray]:
        """Both read-outs (m,)."""
        return {Readout.STRAIN: self.strain, Readout.CHANGE_OF_STRAIN: self.change_of_strain}


def read_receptors(
    components: FloatArray,
    arc: FloatArray,
    measure: Callable[[FloatArray], FloatArray] = maximum_principal,
    settling: int = 0,
    mirrors: bool = False,
) -> Reading:
    """Read-outs at the time at which a measure has changed most: the largest root mean square over arc length, so that
    no mesh matters. That is the reference actuator's peak for a snapshot, the peak of the cycle otherwise.

    components: (1 + n_times, 3m) strains at receptors, of the pre-indented state and along the stimulus. arc: (m,)
    [mm]. measure: of strains (3m,), maximum principal strain [1] if not given. settling: times that pass before any is
    read. mirrors: whether the row does, and its receptors. Where all values count as equal the change is zero.
    """
    # ASSUME: readout: the change of strain is that from the pre-indented state, with its sign (docs/scorings.md)
    before, *strains = (measure(each) for each in (components[0], *components[1 + settling :]))
    changes = np.array([without_rounding(each - before, before) for each in strains])
    size = _size(changes, arc)
    # ASSUME: stimulus.playback: of several times people answer the one at which receptors change most
    time = int(np.argmax(size >= (1.0 - TIED) * size.max()))  # the first of those that mirror
    rival = _rival(changes, size, time, arc, mirrors)
    return Reading(
        time=settling + time,
        strain=strains[time],
        change_of_strain=changes[time],
        rival=settling + rival,
        rival_change=changes[rival],
        rival_peak=float(size[rival] / size[time]) if size[time] > 0.0 else 1.0,
    )


def without_rounding(change: FloatArray, value: FloatArray) -> FloatArray:
    """A change (m,), zero where no more than rounding of the values (m,) is left of it."""
    return change if np.abs(change).max() > CONSTANT * np.abs(value).max() else np.zeros_like(change)


def _rival(changes: FloatArray, size: FloatArray, time: int, arc: FloatArray, mirrors: bool) -> int:
    """`Reading.rival` of changes (n_times, m) of some size (n_times,), but for the times of settling.

    Only times count at which the change is another, by UNLIKE, than what is read, and where the row mirrors than its
    mirror image: those just beside a peak would score alike, as does the other half of such a row's cycle.
    """
    images = [changes[time], changes[time, ::-1]] if mirrors else [changes[time]]
    apart = np.min([_size(changes - image, arc) for image in images], axis=0)
    apart[(size < RIVAL * size[time]) | (apart <= UNLIKE * size[time])] = 0.0
    return int(np.argmax(apart)) if apart.any() else time


def _size(changes: FloatArray, arc: FloatArray) -> FloatArray:
    """Norms (n_times,) of changes (n_times, m) over arc length (m,) [mm]."""
    return np.sqrt(np.trapezoid(changes**2, arc, axis=1))


@dataclass(frozen=True)
class Resampling:
    """Linear map from the receptors, which no condition moves, to a uniform grid.

    grid: (k,) arc lengths [mm]. weights: (k, m) [1]: a read-out (m,) at the receptors is weights @ read-out there.
    """

    grid: FloatArray
    weights: FloatArray
