"""The deformable body of a device's actuators, condensed to its face."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix

from ..errors import MeshError
from ..scene.scene import Scene
from .compliance import CondensedBody
from .condensation import condense
from .elasticity import displacement_basis, node_dofs, stiffness, unit_loads
from .strip import mesh_strip

BODY_FINER = 2.0  # times [1] smaller elements of actuators' bodies than of skin; source: decision 24


def body_of(scene: Scene) -> CondensedBody | None:
    """The condensed body of the scene's actuators, or None if they are rigid. Raises MeshError, CondensationError."""
    return condense_body(scene) if scene.device.actuators.body else None


def condense_body(scene: Scene) -> CondensedBody:
    """Condense the deformable body of the scene's actuators (all equal) to its face; what its base stands on gives way
    to all of the face alike.

    Raises MeshError if the actuators are rigid and as `mesh_strip`, CondensationError as `condense`.
    """
    row = scene.device.actuators
    if row.body is None:
        raise MeshError("a rigid actuator has no body to condense")
    mesh = mesh_strip(row, scene.model.numerics.coarsened(1.0 / BODY_FINER))
    basis = displacement_basis(mesh)
    matrix = stiffness(basis, [row.body.material], np.zeros(mesh.t.shape[1], dtype=int))
    y = mesh.doflocs[1]
    face = np.flatnonzero(y == y.max())
    face = face[np.argsort(mesh.doflocs[0, face])]
    dofs = node_dofs(basis)
    loads = unit_loads(dofs, face, matrix.shape[0])
    none = csr_matrix((0, matrix.shape[0]))
    compliance = condense(matrix, dofs, dofs[:, y == y.min()].ravel(), loads, none).compliance
    return CondensedBody(mesh.doflocs[0, face], compliance + np.tile(row.body.mount(), (face.size, face.size)))
