"""The contact problem that a scene poses, the increments it is followed in, and errors that say whose they are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import numpy as np

from ..errors import ContactError, CriterionError, DepthError, MeshError
from ..scene.contact_law import Criterion, Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.compliance import CondensedBody, CondensedSection
from .formulation import ContactProblem

FRICTIONLESS_SHARE = 2  # without friction one increment in so many [1] is enough; source: fewest seconds (measured)

WHERE = "(in the device file, or in config/config.yaml for every device)"
NARROWER = f"; contact.criterion: depth or force {WHERE} may need less indentation, as a narrower row does"
TOUCH = f"; contact.criterion: touch, depth or force {WHERE} may need less indentation, as a narrower row does"
LESS = {Criterion.DEPTH: "; try less contact.depth", Criterion.FORCE: "; try less contact.force"}
SMALL_ALONE = "; `kinematics: {value: small, ...}` in the device file skips finite strain (docs/troubleshooting.md)"
SHEAR_ALONE = "; `interfaces: {value: shear, ...}` in the device file skips the frictionless case"


def contact_problem(
    scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface
) -> ContactProblem:
    """The contact problem of a scene and an interface. body: of deformable actuators, else None. Raises MeshError if
    that is not so, or an actuator is nearest to no skin node.
    """
    if (body is None) != (scene.device.actuators.body is None):
        found, kind = ("no", "deformable") if body is None else ("a", "rigid")
        raise MeshError(f"{scene.device.name}: found {found} condensed body for {kind} actuators")
    numerics, law = scene.model.numerics, scene.model.contact
    problem = ContactProblem(
        position=section.position,
        compliance=section.compliance,
        row=scene.device.actuators,
        body=body,
        friction=law.coefficient(interface),
        tolerance=numerics.newton_tolerance,
        max_cuts=numerics.max_cuts,
        patches=scene.model.skips.inactive_nodes,
        turning=law.turns(scene.kinematics, interface),
    )
    centres = problem.row.positions
    missed = np.setdiff1d(np.arange(len(centres)), problem.actuator_of)
    if missed.size:
        raise MeshError(
            f"{scene.device.name}: no skin node is near the actuator at x = {centres[missed[0]]:g} mm"
            f" ({missed.size} of {len(centres)} have none); try a smaller numerics.face_size"
        )
    return problem


def increments(scene: Scene, problem: ContactProblem) -> tuple[int, int]:
    """Load increments of pre-indentation and of each segment of a stimulus."""
    numerics, share = scene.model.numerics, 1
    linear = scene.kinematics is Kinematics.SMALL  # much less than all at once is too far for Newton's method
    if scene.model.skips.frictionless_path and problem.friction == 0.0 and linear:
        share = FRICTIONLESS_SHARE
    return -(-numerics.indentation_increments // share), -(-numerics.stimulus_increments // share)


@contextmanager
def named(what: str, advice: Callable[[ContactError], str] = lambda error: "") -> Iterator[None]:
    """Name in every ContactError what was being solved, and say what else may help."""
    try:
        yield
    except ContactError as error:
        error.args = (f"{what}: {error}{advice(error)}",)
        raise


def named_pressing(scene: Scene, interface: Interface) -> AbstractContextManager[None]:
    """`named`, for pre-indentation, which goes the deeper the wider the row is."""
    criterion = scene.model.contact.criterion

    def advice(error: ContactError) -> str:
        # what touches no skin at any height fails with `touch` as well
        touched = not isinstance(error, CriterionError) or error.touched
        less = LESS.get(criterion, TOUCH if criterion is Criterion.FULL and touched else NARROWER)
        return f"{less}{left_out(scene, interface)}"

    return named(f"device={scene.device.name}, interface={interface}, pre-indentation", advice)


def named_stimulus(scene: Scene, condition: Condition, interface: Interface) -> AbstractContextManager[None]:
    """`named`, for the stimulus of a condition; nothing helps against depth."""
    case = f"device={scene.device.name}, condition={condition.name}, interface={interface}"
    return named(case, lambda error: "" if isinstance(error, DepthError) else left_out(scene, interface))


def left_out(scene: Scene, interface: Interface) -> str:
    """What a device's file may leave out where it cannot be solved."""
    finite, frictionless = scene.kinematics is Kinematics.FINITE, interface is Interface.FRICTIONLESS
    return (SMALL_ALONE if finite else "") + (SHEAR_ALONE if frictionless else "")
