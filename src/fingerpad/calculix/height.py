"""The height to which a deck raises the actuators: where fingerpad's criterion ends pre-indentation."""

from __future__ import annotations

from ..contact.linear_solution import indent_device
from ..finite.pressing import press
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.actuator_body import body_of
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh


def indented_height(scene: Scene, section: SectionMesh, interface: Interface) -> float:
    """Height of the faces above the undeformed pad's lowest point [mm] at which pre-indentation ends.

    Raises MeshError, CondensationError, ContactError.
    """
    body = body_of(scene)
    if scene.kinematics is Kinematics.FINITE:
        state = press(scene, section, body, interface).state
    else:
        state = indent_device(scene, condense_section(section, scene), body, interface).state
    return float(state.actuator[0, 1])
