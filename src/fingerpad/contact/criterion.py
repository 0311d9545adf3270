"""When pre-indentation ends: what its criterion still waits for, as a number and in words."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..scene.contact_law import ContactLaw, Criterion
from .formulation import FRONT_POWER, OPEN, ContactProblem, ContactState
from .ownership import given_as
from .profile import profile

# What may be missing at its end: mm of face or gap, share [1] of a force; source: 6e-5 of Device 2's indentation
END_TOLERANCE = 1e-4
NEARLY = 2.0 * END_TOLERANCE  # mm on top of a gap that must close; source: more than what an end may miss
NOBODY = -1  # in place of an actuator's index: beyond the mid-line of a half


def missing_of(problem: ContactProblem, state: ContactState, law: ContactLaw, touch: float) -> float:
    """What the criterion still waits for: face that is not covered, gap that is not closed, way [mm] that is to go from
    a height of first touch [mm], or the share of the force that is not borne [1]; < 0 beyond.
    """
    problem, touching = given_as(problem, state), state.status != OPEN
    if law.criterion is Criterion.DEPTH:
        return touch + law.depth - float(state.actuator[0, 1])
    if law.criterion is Criterion.FORCE:
        return 1.0 - problem.images * float(state.force[:, 1].sum()) / law.force
    if law.criterion is Criterion.TOUCH:
        # more than the gap, so that it does not end just before contact
        gaps = [float(state.gap[own].min(initial=np.inf)) + NEARLY for own in problem.spans if not touching[own].any()]
        return max(gaps, default=0.0)
    return problem.row.half_face - _covered(problem, state)


def _covered(problem: ContactProblem, state: ContactState) -> float:
    """How far [mm] from their centres skin covers the faces at least, on either side."""
    centres, own = np.asarray(problem.row.positions), state.given
    x, closed = state.place + centres[own], state.status != OPEN
    # what touches, also a neighbour, is on its face, not higher by rounding
    height = np.where(closed, 0.0, state.gap) - profile(problem.row, state.place)[0]
    if problem.halved:  # beyond the mid-line lies the mirror image
        beyond = np.flatnonzero(problem.position[:, 0] > 0.0)[::-1]
        own = np.concatenate([np.where(centres[own] == 0.0, own, NOBODY)[beyond], own])
        x = np.concatenate([-x[beyond], x])
        closed, height = (np.concatenate([each[beyond], each]) for each in (closed, height))
    return min(
        front(sign * (x - centre)[::sign], height[::sign], (closed & (own == number))[::sign])
        for number, centre in enumerate(centres)
        for sign in (1, -1)
    )


def wanted(law: ContactLaw) -> str:
    """In words where pre-indentation is to end."""
    asked = {Criterion.DEPTH: f"a depth of {law.depth:g} mm", Criterion.FORCE: f"a force of {law.force:g} N/mm"}
    return asked.get(law.criterion, f"'{law.criterion}' contact")


def _lacking(missing: float, law: ContactLaw) -> str:
    """In words what is missing."""
    if law.criterion is Criterion.FORCE:
        return f"{missing * law.force:.3g} N/mm short"
    return f"{missing:.3g} mm short" if np.isfinite(missing) else "an actuator touches no skin"


def missed(missing: float, way: float, least: tuple[float, float], law: ContactLaw) -> str:
    """In words by how much the criterion was missed at the end of a way [mm] from first touch, and, if that was
    elsewhere, at best: what was missing there, and the way [mm].
    """
    said = f"{_lacking(missing, law)} at {way:.3g} mm"
    if not np.isfinite(least[0]):
        return f"{said}, and all never touched at once"
    return said if least[1] >= way else f"{said}, at best {_lacking(least[0], law)}, at {least[1]:.3g} mm"


def front(place: FloatArray, height: FloatArray, touched: np.ndarray) -> float:
    """Place [mm] up to which skin covers a face in the direction of ascending place (n,), from the last node (n,) that
    touches the actuator on: skin that is no higher than the face, whatever it touches.

    The front is where height to the power FRONT_POWER of the first two higher nodes extrapolates to zero: smooth in the
    load, though nodes close one by one.
    """
    if not touched.any():
        return float("-inf")
    last = int(touched.nonzero()[0][-1])
    higher = (height[last + 1 :] > 0.0).nonzero()[0]
    if higher.size == 0:
        return float(place[-1])
    last += int(higher[0])
    near, far = np.maximum(height[last + 1 : last + 3], 0.0) ** FRONT_POWER if last + 2 < place.size else (0.0, 0.0)
    if far <= near:
        return float(place[last + 1])
    beyond = (place[last + 2] - place[last + 1]) * near / (far - near)
    return float(max(place[last + 1] - beyond, place[last]))
