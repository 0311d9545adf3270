"""Receptor read-outs: maximum principal strain (SA-1 proxy) and its change from pre-indentation (RA-1 proxy)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .compliance import VOIGT
from .readout import CONSTANT, Readout

# of a change [1] by which another one differs from it at least; source: proportional ones that are nearly as large as
# the peak's (`caveats.RIVAL`) differ by a fiftieth
UNLIKE = 0.1


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
    times the one is read at which the measure has changed most, as in `time_read`. Where all values count as equal the
    change is zero. measure: of strains (3m,).
    """
    strains, changes = _along(components, measure)
    peak = _peak(changes, arc)
    return {Readout.STRAIN: strains[peak], Readout.CHANGE_OF_STRAIN: changes[peak]}


def time_read(components: FloatArray, arc: FloatArray) -> int:
    """Which of the stimulus's times is read: that at which maximum principal strain has changed most (largest root mean
    square over arc length, so that no mesh matters), the reference actuator's peak for a snapshot, the peak of the
    cycle otherwise. Arguments as those of `receptor_readouts`.
    """
    return _peak(_along(components, maximum_principal)[1], arc)


def rival_peak(components: FloatArray, arc: FloatArray) -> float:
    """How large maximum principal strain's change is at the time that comes next to being read, over that which is read
    [1]: root mean squares over arc length, of components (1 + n_times, 3m) at receptors (m,) [mm] that mirror. Zero
    without such a time.

    Only times count at which the change is another, by UNLIKE, than what is read, and than its mirror image: those just
    beside a peak would score alike, as does the other half of a cycle whose row mirrors.
    """
    changes = _along(components, maximum_principal)[1]
    size = _size(changes, arc)
    peak = _peak(changes, arc)
    images = np.array([changes[peak], changes[peak, ::-1]])
    apart = np.min([_size(changes - image, arc) for image in images], axis=0)
    return float((size[apart > UNLIKE * size[peak]] / size[peak]).max(initial=0.0))


def _along(components: FloatArray, measure: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, FloatArray]:
    """A measure (n_times, m) along a stimulus, and its change from the pre-indented state, of components
    (1 + n_times, 3m).
    """
    # ASSUME: readout: the change of strain is that from the pre-indented state
    before, *strains = (measure(each) for each in components)
    changes = np.array(strains) - before
    changes[np.abs(changes).max(axis=1) <= CONSTANT * np.abs(before).max()] = 0.0
    return np.array(strains), changes


def _peak(changes: FloatArray, arc: FloatArray) -> int:
    """Index of the largest of changes (k, m) over arc length (m,) [mm]."""
    # ASSUME: stimulus.playback: of several times people answer the one at which receptors change most
    return int(np.argmax(_size(changes, arc)))


def _size(changes: FloatArray, arc: FloatArray) -> FloatArray:
    """Norms (k,) of changes (k, m) over arc length (m,) [mm]."""
    return np.asarray(np.sqrt(np.trapezoid(changes**2, arc, axis=1)))


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
