"""The skin that actuators can reach: where contact is looked for."""

from __future__ import annotations

import numpy as np

from ..errors import MeshError
from ..scene.scene import Scene
from .mesh import SectionMesh
from .traction import Tractions, linear_tractions

MAX_CONTACT = 4000  # skin nodes that may come into contact [1]; source: their compliance then takes half a gigabyte


def contact_tractions(section: SectionMesh, scene: Scene) -> Tractions:
    """Tractions on the skin that an actuator can reach: under a face, or within a margin and the stroke of one, as skin
    that is pressed farther goes farther sideways too; if the mesh mirrors, on its mirror image, too. Where no face gets
    near the mid-line its node is left out: hats beside it are then one half's alone, and soft actuators are pressed by
    halves as well.

    Raises MeshError if no element lies there, or more than MAX_CONTACT nodes.
    """
    row = scene.device.actuators
    points = section.mesh.doflocs[:, section.skin]
    x, y = points
    distance = np.min(np.abs(x[:, None] - np.asarray(row.positions)), axis=1)
    beside = distance - row.width / 2.0 - scene.device.stroke
    within = (beside <= scene.model.numerics.contact_margin) & (y < scene.model.finger.height / 2.0)
    left_out = (x == 0.0) & (beside > scene.model.numerics.contact_margin / 2.0)
    near = within[1::2] & ~left_out[:-1:2] & ~left_out[2::2]
    if not near.any():
        raise MeshError(
            f"{scene.device.name}: no element of the skin lies within reach of an actuator; try a smaller"
            " numerics.face_size"
        )
    tractions = linear_tractions(section.skin, points, near | near[::-1] if section.mirrors else near)
    if tractions.weight.size > MAX_CONTACT:
        raise MeshError(
            f"{scene.device.name}: {tractions.weight.size} skin nodes may come into contact, more than {MAX_CONTACT};"
            " try larger numerics.edge_size and numerics.face_size"
        )
    return tractions
