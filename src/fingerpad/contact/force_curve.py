"""Force of a pre-indentation against its height, recorded on the way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from .formulation import ContactProblem, ContactState, touching_height
from .increment import solve_increment
from .linear_solution import raised
from .path import recording
from .symmetry import part_of

RIPPLE = 1e-3  # of the largest force [1]; source: what increments that were taken back differ by, with friction


def curve_of(states: Sequence[ContactState], touch: float, end: ContactState) -> FloatArray:
    """Heights above first touch [mm] and pressing forces of all actuators [N/mm] (k, 2), by ascending height up to the
    state at which pre-indentation ends: increments that went beyond were taken back. Of these, what lies lower stays.
    """
    points = ((float(state.actuator[0, 1]), float(state.force[:, 1].sum())) for state in states)
    kept = sorted((height - touch, force) for height, force in points if height <= end.actuator[0, 1])
    return np.array([(0.0, 0.0), *kept])


def limit_points(curve: FloatArray) -> NDArray[np.bool_]:
    """Where (k,) the force of a curve (k, 2) has a maximum before it falls, by more than RIPPLE of the largest.

    >>> limit_points(np.array([[0.0, 0.0], [1.0, 2.0], [2.0, 1.0], [3.0, 4.0]])).tolist()
    [False, True, False, False]
    """
    force = curve[:, 1]
    ripple, found = RIPPLE * float(np.abs(force).max()), np.zeros(force.size, dtype=bool)
    turn, rising = 0, True  # where force was last as high, or as low, as it has been since the last limit
    for place in range(force.size):
        change = float(force[place] - force[turn]) * (1.0 if rising else -1.0)
        if change > 0.0:
            turn = place
        elif change < -ripple:
            found[turn], turn, rising = rising, place, not rising
    return found


def curve_rows(device: str, interface: Interface, kinematics: Kinematics, curve: FloatArray) -> list[dict[str, Any]]:
    """Rows of the table of indentation for a curve (k, 2): height, force, and whether it is one of `limit_points`."""
    case = {"kinematics": str(kinematics), "device": device, "interface": str(interface)}
    return [
        case | {"indentation_mm": float(height), "force_N_per_mm": float(force), "limit_point": bool(limit)}
        for (height, force), limit in zip(curve, limit_points(curve), strict=True)
    ]


def small_strain_curve(scene: Scene, problem: ContactProblem) -> FloatArray:
    """The curve (k, 2) of a scene with small kinematics. Raises ContactError."""
    states: list[ContactState] = []
    part = part_of(problem, scene.model.skips.mirrored_half)
    end = raised(scene, part, recording(solve_increment, states.append))
    return curve_of(states, touching_height(part), end) * [1.0, part.images]
