"""Pre-indentation: the actuators rise together until they are in contact as the criterion asks."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from ..arrays import FloatArray
from ..errors import CriterionError
from ..scene.contact_law import Criterion
from .formulation import FRONT_POWER, OPEN, ContactProblem, ContactState, rest, touching_height
from .increment import solve_increment
from .path import Carried, SolveIncrement, advance
from .profile import profile

State = TypeVar("State", bound=ContactState)

END_TOLERANCE = 1e-4  # mm of face or gap that may be missing at its end; source: 6e-5 of Device 2's indentation
FAR = 4.0  # ways from first touch to the outermost face [1] after which increments grow; source: devices need 1.8
END_STEP = 1e-4  # mm of height below which an increment is not taken back; source: as END_TOLERANCE
LEAST_STEP = 1e-6  # mm; source: a hundredth of END_STEP, so that no step drowns in rounding


def indent(problem: ContactProblem, criterion: Criterion, increments: int, limit: float) -> ContactState:
    """Raise all actuators together until the criterion holds, on linear tissue. Raises as `raise_until`."""
    start = rest(problem, touching_height(problem))
    return raise_until(problem, criterion, increments, limit, start, solve_increment)


def raise_until(
    problem: ContactProblem,
    criterion: Criterion,
    increments: int,
    limit: float,
    state: State,
    solve: SolveIncrement[State, Carried | None],
) -> State:
    """Raise all actuators together until the criterion holds.

    FULL: contact reaches both ends of every flat face. TOUCH: every actuator carries some skin. increments: number for
    the way from first touch to where the undeformed skin over the outermost face would lie. limit: largest
    indentation [mm]. state: at first touch. solve: an increment.

    Raises CriterionError if the criterion is not met within the limit, and what `path.advance` raises.
    """
    touch = float(state.actuator[0, 1])
    carried: Carried | None = None
    over_face = np.abs(state.place) <= problem.row.half_face
    rise = float(problem.position[over_face, 1].max(initial=touch)) - touch
    stride = max(rise / increments, END_STEP)
    missing, step = _missing(problem, state, criterion), stride
    least = missing, touch  # that was missing, and at which height
    beyond: tuple[float, float] | None = None  # height at which the faces are more than covered, and what is missing
    weight = 1.0  # of the side that false position has kept (Illinois variant: halved each time)
    while missing > END_TOLERANCE:
        height = float(state.actuator[0, 1]) + step
        if height - touch > limit:
            raise CriterionError(
                f"pre-indentation did not reach '{criterion}' contact within {limit:g} mm from first touch:"
                f" {_lacking(missing)} at {height - step - touch:.3g} mm{_nearest(*least, touch)}",
                touched=bool(np.isfinite(least[0])),
            )
        target = state.actuator.copy()
        target[:, 1] = height
        advanced, carried = advance(problem, state, target, 1, carried, solve)
        left = _missing(problem, advanced, criterion)
        least = min(least, (left, height))
        if left < -END_TOLERANCE and step > END_STEP:
            weight = weight / 2.0 if beyond else 1.0
            beyond = height, left  # too far: again from the same state
        else:
            closed = (missing - left) / step if np.isfinite(missing) else 0.0
            state, missing = advanced, left
            if beyond and height > beyond[0] - LEAST_STEP:
                beyond = None  # what lay beyond in one increment does not in many: friction remembers them
            longest = stride * max(1.0, (height - touch) / (FAR * stride * increments))
            step = min(longest, left / closed) if closed > 0.0 else longest
            weight = 2.0 * weight
        if beyond and missing > 0.0:
            share = weight * missing / (weight * missing - beyond[1]) if np.isfinite(missing) else 0.5
            step = (beyond[0] - float(state.actuator[0, 1])) * share
        step = max(step, LEAST_STEP)
    return state


def _missing(problem: ContactProblem, state: ContactState, criterion: Criterion) -> float:
    """What the criterion still waits for [mm]: face that is not covered, or gap that is not closed; < 0 beyond."""
    touching = state.status != OPEN
    if criterion is Criterion.TOUCH:
        return max(0.0 if touching[own].any() else float(state.gap[own].min()) for own in problem.spans)
    height = state.gap - profile(problem.row, state.place)[0]
    covered = min(
        front(sign * state.place[own][::sign], height[own][::sign], touching[own][::sign])
        for own in problem.spans
        for sign in (1, -1)
    )
    return problem.row.half_face - covered


def _lacking(missing: float) -> str:
    """In words what is missing [mm]."""
    return f"{missing:.3g} mm short" if np.isfinite(missing) else "an actuator touches no skin"


def _nearest(least: float, height: float, touch: float) -> str:
    """In words at which height least was missing [mm]."""
    if not np.isfinite(least):
        return ", and all never touched at once"
    return f", at best {least:.3g} mm at {height - touch:.3g} mm"


def front(place: FloatArray, height: FloatArray, active: np.ndarray) -> float:
    """Place [mm] up to which one actuator's skin is in contact in the direction of ascending place (n,).

    The front is where height to the power FRONT_POWER of the first two open nodes extrapolates to zero: smooth in the
    load, though nodes close one by one.
    """
    closed = active.nonzero()[0]
    if closed.size == 0:
        return float("-inf")  # not even touched
    last = int(closed[-1])
    near, far = np.maximum(height[last + 1 : last + 3], 0.0) ** FRONT_POWER if last + 2 < place.size else (0.0, 0.0)
    if far <= near:
        return float(place[min(last + 1, place.size - 1)])
    beyond = (place[last + 2] - place[last + 1]) * near / (far - near)
    return float(max(place[last + 1] - beyond, place[last]))
