"""How deep actuators stand in the tissue."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray
from .contact import ContactProblem
from .errors import DepthError
from .profile import profile


def depth(problem: ContactProblem, actuators: FloatArray) -> float:
    """Largest height [mm] of an actuator, in any of its places (k, n_actuators, 2) [mm], above that at which it first
    touches undeformed skin.
    """
    x = problem.position[:, 0] - np.asarray(problem.row.positions)[problem.actuator_of]
    height = problem.position[:, 1] + profile(problem.row, x)[0]
    touching = np.array([height[own].min() for own in problem.spans])
    return float((actuators[:, :, 1] - touching).max())


def require_tissue(problem: ContactProblem, actuators: FloatArray, thickness: float) -> None:
    """Raise DepthError if actuators go deeper than the tissue is thick [mm] in any of their places (k, n_actuators, 2).

    Linear tissue would let them pass through the bone.
    """
    deepest = depth(problem, actuators)
    if deepest > thickness:
        raise DepthError(
            f"the stimulus presses an actuator {deepest:.3g} mm deep, into {thickness:g} mm of tissue; try less of it"
        )
