"""How deep actuators stand in the tissue."""

from __future__ import annotations

from ..arrays import FloatArray
from ..errors import DepthError
from .formulation import ContactProblem
from .profile import touching_heights


def depth(problem: ContactProblem, actuators: FloatArray) -> float:
    """Largest height [mm] of an actuator, in any of its places (k, n_actuators, 2) [mm], above that at which it first
    touches undeformed skin.
    """
    return float((actuators[:, :, 1] - touching_heights(problem.row, problem.position)).max())


def require_tissue(problem: ContactProblem, actuators: FloatArray, thickness: float) -> None:
    """Raise DepthError if actuators go deeper than the tissue is thick [mm] in any of their places (k, n_actuators, 2).

    Linear tissue would let them pass through the bone.
    """
    deepest = depth(problem, actuators)
    if deepest > thickness:
        raise DepthError(
            f"the stimulus presses an actuator {deepest:.3g} mm deep, into {thickness:g} mm of tissue; reduce it,"
            " or check that its displacements are in mm"
        )
