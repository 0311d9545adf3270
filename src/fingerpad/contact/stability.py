"""Whether deformed tissue is stable while actuators hold what they touch.

Under prescribed displacements a falling force is stable, and followed; a state is lost where the stiffness K loses its
positive sign on all movements that leave contact as it is: A u = 0, with A the components that contact holds. With the
compliance C of those components the number of movements with a negative sign is
    n(K on A u = 0) = n(K) - n(A C A^T),        n: negative eigenvalues
(Haynsworth 1968, inertia of a bordered matrix), and n(K) is the number of negative pivots of its factors (Sylvester).
Nodes that stick hold both components, nodes that slip the one across the face; what friction and curved faces add to
the stiffness is left out.
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..tissue.factors import Factors
from .faces import nodal_compliance, touch
from .formulation import OPEN, ContactProblem, Status


def unstable_directions(problem: ContactProblem, status: np.ndarray, place: FloatArray, factors: Factors) -> int:
    """Number of movements that lower the energy while contact holds its nodes, of states (n,) and places (n,) [mm].

    problem: with the compliance of the tissue whose stiffness has these factors.
    """
    negative = int(np.count_nonzero(factors.pivots < 0.0))
    active = np.flatnonzero(status != OPEN)
    if negative == 0 or active.size == 0:
        return negative
    compliance = nodal_compliance(problem, active, touch(problem, place))
    held = np.flatnonzero(
        np.concatenate([status[active] == Status.STICK, np.ones(active.size, dtype=bool)])
        & (np.diag(compliance) != 0.0)  # what a mid-line holds, contact need not hold
    )
    return negative - int(np.count_nonzero(np.linalg.eigvalsh(compliance[np.ix_(held, held)]) < 0.0))
