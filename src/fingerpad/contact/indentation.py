"""Pre-indentation: the actuators rise together until they are in contact as the criterion asks."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from ..arrays import FloatArray
from ..errors import CriterionError
from ..scene.contact_law import ContactLaw, Criterion
from .formulation import FRONT_POWER, OPEN, ContactProblem, ContactState, rest, touching_height
from .increment import solve_increment
from .ownership import given_as
from .path import Carried, SolveIncrement, advance
from .profile import profile

State = TypeVar("State", bound=ContactState)

# What may be missing at its end: mm of face, gap or depth, share [1] of a force; source: 6e-5 of Device 2's indentation
END_TOLERANCE = 1e-4
FAR = 4.0  # ways from first touch to the outermost face [1] after which increments grow; source: devices need 1.8
END_STEP = 1e-4  # mm of height below which an increment is not taken back, but for a force; source: as END_TOLERANCE
# Of the limit [1], the least way in whose increments a force is sought; source: a third of the devices' way
SHALLOW = 0.1
LEAST_STEP = 1e-6  # mm; source: a hundredth of END_STEP, so that no step drowns in rounding
NEARLY = 2.0 * END_TOLERANCE  # mm on top of a gap that must close; source: more than what an end may miss
NOBODY = -1  # in place of an actuator's index: beyond the mid-line of a half


def indent(problem: ContactProblem, law: ContactLaw, increments: int, limit: float) -> ContactState:
    """Raise all actuators together until the law's criterion holds, on linear tissue. Raises as `raise_until`."""
    start = rest(problem, touching_height(problem))
    return raise_until(problem, law, increments, limit, start, solve_increment)


def raise_until(
    problem: ContactProblem,
    law: ContactLaw,
    increments: int,
    limit: float,
    state: State,
    solve: SolveIncrement[State, Carried | None],
) -> State:
    """Raise all actuators together until the law's criterion holds.

    FULL: contact reaches both ends of every flat face. TOUCH: every actuator carries some skin. DEPTH: that of the row
    from first touch. FORCE: that all press with. increments: number for the way to that depth, or from first touch to
    where the undeformed skin over the outermost face would lie. limit: largest indentation [mm]. state: at first touch.
    solve: an increment.

    Raises CriterionError if the criterion is not met within the limit, and what `path.advance` raises.
    """
    touch = float(state.actuator[0, 1])
    carried: Carried | None = None
    over_face = np.abs(state.place) <= problem.row.half_face
    rise = float(problem.position[over_face, 1].max(initial=touch)) - touch
    way = {Criterion.DEPTH: law.depth, Criterion.FORCE: max(rise, SHALLOW * limit)}.get(law.criterion, rise)
    stride = max(way / increments, END_STEP)
    missing, step = _missing(problem, state, law, touch), stride
    least = missing, touch  # that was missing, and at which height
    beyond: tuple[float, float] | None = None  # height at which the faces are more than covered, and what is missing
    weight = 1.0  # of the side that false position has kept (Illinois variant: halved each time)
    while missing > END_TOLERANCE:
        height = float(state.actuator[0, 1]) + step
        if height - touch > limit:
            raise CriterionError(
                f"pre-indentation did not reach {_wanted(law)} within {limit:g} mm from first touch:"
                f" {_lacking(missing, law)} at {height - step - touch:.3g} mm{_nearest(*least, touch, law)}",
                touched=bool(np.isfinite(least[0])),
            )
        target = state.actuator.copy()
        target[:, 1] = height
        advanced, carried = advance(problem, state, target, 1, carried, solve)
        left = _missing(problem, advanced, law, touch)
        least = min(least, (left, height))
        if left < -END_TOLERANCE and step > (LEAST_STEP if law.criterion is Criterion.FORCE else END_STEP):
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


def _missing(problem: ContactProblem, state: ContactState, law: ContactLaw, touch: float) -> float:
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
    height = state.gap - profile(problem.row, state.place)[0]
    if problem.images > 1:  # beyond the mid-line lies the mirror image
        beyond = np.flatnonzero(problem.position[:, 0] > 0.0)[::-1]
        own = np.concatenate([np.where(centres[own] == 0.0, own, NOBODY)[beyond], own])
        x = np.concatenate([-x[beyond], x])
        closed, height = (np.concatenate([each[beyond], each]) for each in (closed, height))
    return min(
        front(sign * (x - centre)[::sign], height[::sign], (closed & (own == number))[::sign])
        for number, centre in enumerate(centres)
        for sign in (1, -1)
    )


def _wanted(law: ContactLaw) -> str:
    """In words where pre-indentation is to end."""
    asked = {Criterion.DEPTH: f"a depth of {law.depth:g} mm", Criterion.FORCE: f"a force of {law.force:g} N/mm"}
    return asked.get(law.criterion, f"'{law.criterion}' contact")


def _lacking(missing: float, law: ContactLaw) -> str:
    """In words what is missing."""
    if law.criterion is Criterion.FORCE:
        return f"{missing * law.force:.3g} N/mm short"
    return f"{missing:.3g} mm short" if np.isfinite(missing) else "an actuator touches no skin"


def _nearest(least: float, height: float, touch: float, law: ContactLaw) -> str:
    """In words at which height least was missing."""
    if not np.isfinite(least):
        return ", and all never touched at once"
    short = _lacking(least, law).removesuffix(" short")
    return f", at best {short} at {height - touch:.3g} mm"


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
