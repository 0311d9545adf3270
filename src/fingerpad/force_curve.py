"""Force of a pre-indentation against its height, recorded on the way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .contact import ContactProblem, ContactState, rest, touching_height
from .increment import solve_increment
from .indentation import raise_until
from .path import SolveIncrement, State
from .scene import FloatArray, Scene
from .solution import increments


def recording(solve: SolveIncrement[State], note: Callable[[ContactState], object]) -> SolveIncrement[State]:
    """An increment's solver that shows every state it finds."""

    def solve_and_note(problem: ContactProblem, start: State, actuator: FloatArray, carried: Any) -> tuple[State, Any]:
        state, left = solve(problem, start, actuator, carried)
        note(state)
        return state, left

    return solve_and_note


def curve_of(states: list[ContactState], touch: float) -> FloatArray:
    """Heights above first touch [mm] and pressing forces of all actuators [N/mm] (k, 2), by ascending height."""
    points = sorted((float(state.actuator[0, 1]) - touch, float(state.force[:, 1].sum())) for state in states)
    return np.array([(0.0, 0.0), *points])


def small_strain_curve(scene: Scene, problem: ContactProblem) -> FloatArray:
    """The curve (k, 2) of a scene with small kinematics. Raises ContactError."""
    states: list[ContactState] = []
    touch = touching_height(problem)
    solve = recording(solve_increment, states.append)
    limit, (count, _) = scene.model.finger.pad_thickness, increments(scene, problem)
    raise_until(problem, scene.model.contact.criterion, count, limit, rest(problem, touch), solve)
    return curve_of(states, touch)
