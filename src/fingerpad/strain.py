"""Receptor read-outs: maximum principal strain (SA-1 proxy) and its change from pre-indentation (RA-1 proxy)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .compliance import VOIGT
from .readout import CONSTANT, Readout


def maximum_principal(components: FloatArray) -> FloatArray:
    """Largest of the three principal strains (m,) [1] in plane strain, from (3m,) exx, eyy, gxy point by point.

    The in-plane pair is (exx + eyy)/2 +- sqrt(((exx - eyy)/2)^2 + (gxy/2)^2); the third, out of the plane, is zero.

    >>> maximum_principal(np.array([0.01, -0.02, 0.0, -0.01, -0.01, 0.0])).round(12).tolist()
    [0.01, 0.0]
    """
    exx, eyy, gxy = components.reshape(-1, VOIGT).T
    in_plane = (exx + eyy) / 2.0 + np.hypot((exx - eyy) / 2.0, gxy / 2.0)
    return np.maximum(in_plane, 0.0)


def receptor_readouts(
    components: FloatArray, arc: FloatArray, measure: Callable[[FloatArray], FloatArray] = maximum_principal
) -> dict[Readout, FloatArray]:
    """Both read-outs (m,) at the receptors, in the unit of the measure: of maximum principal strain [1].

    components: (1 + n_times, 3m) strains, of the pre-indented state and along the stimulus. arc: (m,) [mm]. Of several
    times the one is read that `time_read` names. Where all values count as equal the change is zero. measure: of
    strains (3m,).
    """
    strains, changes = _measured(components, measure)
    peak = time_read(components, arc, measure)
    return {Readout.STRAIN: strains[peak], Readout.CHANGE_OF_STRAIN: changes[peak]}


def time_read(
    components: FloatArray, arc: FloatArray, measure: Callable[[FloatArray], FloatArray] = maximum_principal
) -> int:
    """Which of the stimulus's times is read: that at which the measure has changed most (largest root mean square over
    arc length, so that no mesh matters), the reference actuator's peak for a snapshot, the peak of the cycle otherwise.
    Arguments as those of `receptor_readouts`.
    """
    # ASSUME: stimulus.playback: of several times people answer the one at which receptors change most
    _, changes = _measured(components, measure)
    return int(np.argmax(np.trapezoid(changes**2, arc, axis=1)))


def _measured(components: FloatArray, measure: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, FloatArray]:
    """The measure (n_times, m) along the stimulus, and its changes."""
    # ASSUME: readout: the change of strain is that from the pre-indented state
    before, *strains = (measure(each) for each in components)
    changes = np.array(strains) - before
    changes[np.abs(changes).max(axis=1) <= CONSTANT * np.abs(before).max()] = 0.0
    return np.array(strains), changes


@dataclass(frozen=True)
class Resampling:
    """Linear map from the receptors, which no condition moves, to a uniform grid.

    grid: (k,) arc lengths [mm]. weights: (k, m) [1]: a read-out (m,) at the receptors is weights @ read-out there.
    """

    grid: FloatArray
    weights: FloatArray


@dataclass(frozen=True)
class FilteredReadouts:
    """Read-outs of one condition on the uniform grid, before and after the filter.

    arc: (k,) [mm]. strain, change_of_strain: (k,) [1]. filtered_strain, filtered_change_of_strain: (k,) [mm].
    """

    arc: FloatArray
    strain: FloatArray
    change_of_strain: FloatArray
    filtered_strain: FloatArray
    filtered_change_of_strain: FloatArray

    def unfiltered(self, readout: Readout) -> FloatArray:
        """The read-out (k,) [1] before the filter."""
        return self.strain if readout is Readout.STRAIN else self.change_of_strain

    def filtered(self, readout: Readout) -> FloatArray:
        """The filtered read-out (k,) [mm]."""
        return self.filtered_strain if readout is Readout.STRAIN else self.filtered_change_of_strain
