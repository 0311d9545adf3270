"""The contact problem that a scene poses, and the increments it is followed in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import MeshError
from ..scene.contact_law import FrictionFrom, Interface
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.compliance import CondensedBody, CondensedSection
from .formulation import ContactProblem, ContactState, switch_friction

FRICTIONLESS_SHARE = 2  # without friction one increment in so many [1] is enough; source: fewest seconds (measured)


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


def pressing_problem(scene: Scene, problem: ContactProblem) -> ContactProblem:
    """The problem that pre-indentation poses: without friction where that acts from the stimulus on."""
    # ASSUME: contact.friction_from: whether skin also rubs while the device is pressed
    from_touch = scene.model.contact.friction_from is FrictionFrom.TOUCH
    return problem if from_touch or problem.friction == 0.0 else replace(problem, friction=0.0)


def once_pressed(state: ContactState, pressing: ContactProblem, acting: ContactProblem) -> ContactState:
    """The state in which pre-indentation ends, with the friction that acts from the stimulus on.

    pressing: what pre-indentation posed. acting: what the stimulus poses.
    """
    return switch_friction(state) if pressing.friction < acting.friction else state


def indentation_increments(scene: Scene, problem: ContactProblem) -> int:
    """Load increments of pre-indentation [1]."""
    return -(-scene.model.numerics.indentation_increments // _share(scene, problem))


def stimulus_increments(scene: Scene, problem: ContactProblem) -> int:
    """Load increments of each segment of a stimulus [1]."""
    return -(-scene.model.numerics.stimulus_increments // _share(scene, problem))


def _share(scene: Scene, problem: ContactProblem) -> int:
    """One of how many increments [1] is enough: without friction the way leaves no trace on linear tissue, but is too
    far for Newton's method on tissue that deforms much.
    """
    linear = scene.kinematics is Kinematics.SMALL
    shorter = scene.model.skips.frictionless_path and problem.friction == 0.0 and linear
    return FRICTIONLESS_SHARE if shorter else 1
