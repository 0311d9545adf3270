"""Pre-indentation: the actuators rise together until they are in contact as the criterion asks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from ..errors import ContactError, CriterionError
from ..scene.contact_law import ContactLaw, Criterion
from .criterion import END_TOLERANCE, missed, missing_of, wanted
from .formulation import ContactProblem, ContactState, rest, touching_height
from .increment import solve_increment
from .patch import Patch
from .path import Carried, SolveIncrement, advance, recording

State = TypeVar("State", bound=ContactState)

FAR = 4.0  # ways from first touch to the outermost face [1] after which increments grow; source: devices need 1.8
END_STEP = 1e-4  # mm of height below which an increment is not taken back, but for a force; source: as END_TOLERANCE
# Of the limit [1], the least way in whose increments a force is sought; source: a third of the devices' way
SHALLOW = 0.1
LEAST_STEP = 1e-6  # mm; source: a hundredth of END_STEP, so that no step drowns in rounding


def indent(
    problem: ContactProblem,
    law: ContactLaw,
    increments: int,
    limit: float,
    solve: SolveIncrement[ContactState, Patch | None] = solve_increment,
) -> ContactState:
    """Raise all actuators together from first touch until the law's criterion holds, on linear tissue. Raises as
    `raise_until`.
    """
    return raise_until(problem, law, increments, limit, rest(problem, touching_height(problem)), solve)


def raise_until(
    problem: ContactProblem,
    law: ContactLaw,
    increments: int,
    limit: float,
    state: State,
    solve: SolveIncrement[State, Carried | None],
) -> State:
    """Raise all actuators together until the law's criterion holds.

    FULL: contact reaches both ends of every flat face, or the middle of a round one. TOUCH: every actuator carries some
    skin. DEPTH: that of the row from first touch. FORCE: that all press with. increments: number for the way to that
    depth, or from first touch to where the undeformed skin over the outermost face, or its middle, would lie; to a
    force, for SHALLOW of the limit if that is farther. limit: largest indentation [mm]. state: at first touch. solve:
    an increment.

    Raises CriterionError if the criterion is not met within the limit, and what `path.advance` raises, unless that is
    lost beyond the end.
    """
    touch = float(state.actuator[0, 1])
    carried: Carried | None = None
    stride = max(_way(problem, law, limit, state) / increments, END_STEP)
    missing = missing_of(problem, state, law, touch)
    step = min(stride, missing) if law.criterion in (Criterion.TOUCH, Criterion.DEPTH) else stride  # missing is a way
    least = missing, 0.0  # that was missing, and after which way
    beyond: _Beyond | None = None
    enough = LEAST_STEP if law.criterion is Criterion.DEPTH else END_TOLERANCE  # a way that is known is gone to its end
    while missing > enough:
        here = float(state.actuator[0, 1])
        if touch + limit - here <= LEAST_STEP:
            raise _out_of_reach(law, limit, missed(missing, here - touch, least, law), least[0])
        step = min(step, touch + limit - here)
        height = here + step
        passed, carried, lost = _raised(problem, state, height, carried, solve)
        left = missing_of(problem, passed[-1], law, touch)
        if lost is not None:
            if left > enough:
                raise lost
            height = float(passed[-1].actuator[0, 1])  # what is lost lies beyond the end
            step = height - here
        if _is_too_far(law, left, step):
            # again from the last state on the way that was not; beside a new one, what is beyond weighs whole
            state = next(each for each in reversed(passed) if missing_of(problem, each, law, touch) > enough)
            missing = missing_of(problem, state, law, touch)
            beyond = _Beyond(height, left, beyond.weight / 2.0 if beyond and state is passed[0] else 1.0)
        else:
            closed = (missing - left) / step if np.isfinite(missing) else 0.0
            state, missing = passed[-1], left
            least = min(least, (left, height - touch))
            longest = stride * max(1.0, (height - touch) / (FAR * stride * increments))
            step = min(longest, left / closed) if closed > 0.0 else longest
            beyond = beyond.after(height) if beyond else None
        if beyond and missing > 0.0:
            step = (beyond.height - float(state.actuator[0, 1])) * beyond.share(missing)
        step = max(step, LEAST_STEP)
    return state


def _is_too_far(law: ContactLaw, left: float, step: float) -> bool:
    """Whether an increment of a height [mm], after which so much is missing, is to be taken back."""
    return left < -END_TOLERANCE and step > (LEAST_STEP if law.criterion is Criterion.FORCE else END_STEP)


def _out_of_reach(law: ContactLaw, limit: float, told: str, least: float) -> CriterionError:
    """The error that the criterion is not met within a limit [mm]. told: what is missing. least: so much of it was."""
    message = f"pre-indentation did not reach {wanted(law)} within {limit:g} mm from first touch: {told}"
    return CriterionError(message, touched=bool(np.isfinite(least)))


def _raised(
    problem: ContactProblem,
    state: State,
    height: float,
    carried: Carried | None,
    solve: SolveIncrement[State, Carried | None],
) -> tuple[list[State], Carried | None, ContactError | None]:
    """States on the way of all actuators to a height [mm], the first of them where it begins; what the last increment
    left; and why the way ends before, if it does.
    """
    target, passed = state.actuator.copy(), [state]
    target[:, 1] = height
    try:
        _, carried = advance(problem, state, target, 1, carried, recording(solve, passed.append))
    except ContactError as lost:
        return passed, carried, lost
    return passed, carried, None


@dataclass(frozen=True)
class _Beyond:
    """An increment that went too far: the height it ended at [mm], what was missing there, below zero, and how much
    what is missing before it weighs [1] in false position: half as much with each end that follows on this side, twice
    with each on the other (Illinois).
    """

    height: float
    missing: float
    weight: float

    def share(self, missing: float) -> float:
        """Share [1] of the way there from a state in which so much is missing, at which nothing would be."""
        before = self.weight * missing
        return before / (before - self.missing) if np.isfinite(missing) else 0.5

    def after(self, height: float) -> _Beyond | None:
        """Once a height [mm] on this side is reached: none any more where that is the height that was too far. Friction
        remembers the way, so that one long increment may go too far where many short ones do not.
        """
        return None if height > self.height - LEAST_STEP else replace(self, weight=2.0 * self.weight)


def _way(problem: ContactProblem, law: ContactLaw, limit: float, state: ContactState) -> float:
    """The way [mm] that is gone in the increments of pre-indentation, from a state at first touch."""
    touch, aside = float(state.actuator[0, 1]), np.abs(state.place)
    over_face = aside <= problem.row.half_face
    for own in problem.spans:  # a round actuator has no face, a narrow one maybe no node over it
        over_face[own.start + int(aside[own].argmin())] = True
    rise = float(problem.position[over_face, 1].max(initial=touch)) - touch
    return {Criterion.DEPTH: law.depth, Criterion.FORCE: max(rise, SHALLOW * limit)}.get(law.criterion, rise)
