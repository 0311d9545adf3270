"""Anderson's acceleration of a fixed point (Walker and Ni 2011)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray

MEMORY = 12  # iterates [1] that are combined; source: fewest corrections of 6, 8, 12


def accelerated(
    steps: Sequence[FloatArray], ends: Sequence[FloatArray], loads: Sequence[FloatArray] | None = None
) -> FloatArray:
    """The next iterate of u = G(u), from steps G(u) - u and ends G(u) of the iterations so far, oldest first: the
    combination of the last MEMORY ends whose steps nearly cancel; of one iteration its end.

    loads: that cause the steps on a linear structure, whose energy then is the measure of what is left of the steps.

    >>> halved = [np.array([2.0]), np.array([1.0])]
    >>> accelerated([0.5 * u - u for u in halved], [0.5 * u for u in halved])
    array([0.])
    """
    if len(steps) == 1:
        return ends[0]
    step, end = np.array(steps[-MEMORY:]), np.array(ends[-MEMORY:])
    changes = np.diff(step, axis=0)
    if loads is None:
        weights = np.linalg.lstsq(changes.T, steps[-1], rcond=None)[0]
    else:
        energy = changes @ np.diff(np.array(loads[-MEMORY:]), axis=0).T
        weights = np.linalg.lstsq((energy + energy.T) / 2.0, changes @ loads[-1], rcond=None)[0]
    return ends[-1] - weights @ np.diff(end, axis=0)
