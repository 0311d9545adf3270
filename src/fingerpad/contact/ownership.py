"""Whose skin is whose: the one actuator that each node can touch.

A node is given to another actuator as it goes sideways. Actuators stay in order along the skin.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..scene.device import nearest
from .formulation import OPEN, ContactProblem, ContactState, centres
from .profile import profile


def touches_both(one: float, other: float) -> str:
    """What to say where skin touches two actuators at once, which rest at these places [mm]: where they are close it
    lies against both, and a node can be given to one alone.
    """
    left, right = sorted([one, other])
    return (
        f"skin touches the actuators at x = {left:.4g} and {right:.4g} mm at once, which contact does not know; try"
        " less indentation, less movement, wider gaps"
    )


def given_as(problem: ContactProblem, state: ContactState) -> ContactProblem:
    """The problem with its nodes given to the actuators that they have in a state."""
    return problem if np.array_equal(problem.actuator_of, state.given) else replace(problem, given=state.given)


def given_anew(problem: ContactProblem, state: ContactState) -> tuple[ContactProblem, ContactState]:
    """Problem and state with open nodes given to the actuator that they are nearest to now, as skin goes sideways.
    Nodes beside contact stay, as hats there reach to them, and so does the order of actuators along the skin.
    """
    own, closest = state.given, nearest_now(problem, state)
    if np.array_equal(closest, own):  # as nearly always
        return given_as(problem, state), state
    touching = state.status != OPEN
    kept = touching.copy()
    kept[1:] |= touching[:-1]
    kept[:-1] |= touching[1:]
    if (kept | (closest == own)).all():
        return given_as(problem, state), state
    wanted = np.where(kept, own, closest)
    least = np.maximum.accumulate(np.where(touching, own, 0))
    most = np.minimum.accumulate(np.where(touching, own, len(problem.row.positions) - 1)[::-1])[::-1]
    return given_to(problem, state, np.maximum.accumulate(np.clip(wanted, least, most)))


def given_to(problem: ContactProblem, state: ContactState, given: np.ndarray) -> tuple[ContactProblem, ContactState]:
    """Problem and state with nodes given to other actuators (n,), which they do not touch until an increment is solved:
    forces from those that they had, and how far deformable faces of these gave way, stay until then.
    """
    own, moved = state.given, state.given != given
    centre = centres(problem, state.actuator)
    aside, above = (centre[own] - centre[given]).T
    place = state.place + aside
    height = state.gap - profile(problem.row, state.place)[0] + above
    anew = replace(
        state,
        given=given,
        status=np.where(moved, OPEN, state.status),
        place=place,
        gap=height + profile(problem.row, place)[0],
        drift=np.where(moved[:, None], 0.0, state.drift),  # over another actuator it promises nothing
        trend=np.where(moved[:, None], 0.0, state.trend),
    )
    return given_as(problem, anew), anew


def nearest_now(problem: ContactProblem, state: ContactState) -> np.ndarray:
    """Index (n,) of the actuator whose centre is nearest along x to where each node is now."""
    centre = state.actuator[:, 0] + problem.row.positions
    return nearest(centre, state.place + centre[state.given])


def overlapped(problem: ContactProblem, state: ContactState, allowed: float) -> np.ndarray:
    """Nodes (n,) that overlap, by more than is allowed [mm], the actuator that they are nearest to but not given to."""
    closest = nearest_now(problem, state)
    astray = closest != state.given
    if astray.any():
        astray &= given_to(problem, state, closest)[1].gap < -allowed
    return astray


def handed_over(problem: ContactProblem, state: ContactState, allowed: float) -> np.ndarray:
    """Index (n,) of each node's actuator: as in the state, but nodes that overlap another actuator are given to that
    one. Actuators stay in order along the skin.
    """
    own, astray = state.given, overlapped(problem, state, allowed)
    if not astray.any():
        return own
    wanted = np.where(astray, nearest_now(problem, state), own)
    rightwards = np.maximum.accumulate(np.maximum(wanted, own))
    return np.minimum.accumulate(np.where(wanted < own, wanted, rightwards)[::-1])[::-1]
