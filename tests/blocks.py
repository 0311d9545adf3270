"""Rectangular elastic blocks for tests against closed forms: the face that is touched lies on y = 0."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix
from skfem import MeshTri, MeshTri2

from fingerpad.condensation import condense
from fingerpad.contact import ContactProblem
from fingerpad.elasticity import displacement_basis, node_dofs, stiffness
from fingerpad.scene import ActuatorRow, FloatArray, Material

TOLERANCE = 1e-10


def graded(fine: float, start: float, growth: float, end: float) -> FloatArray:
    """Coordinates from 0 to `end`, steps `fine` up to `start` and growing by the factor `growth` from there."""
    points = list(np.linspace(0.0, start, round(start / fine) + 1))
    while points[-1] < end:
        points.append(points[-1] + max((points[-1] - points[-2]) * growth, fine))
    return np.array(points) * end / points[-1]


def block(x: FloatArray, y: FloatArray) -> MeshTri2:
    """Second-order triangles on a tensor grid that mirrors about x = 0, diagonals included; x and y ascending."""
    half = MeshTri.init_tensor(x[x >= 0.0], y)
    mirror = MeshTri(half.p * np.array([[-1.0], [1.0]]), half.t)
    return MeshTri2.from_mesh(half + mirror)


def block_problem(
    mesh: MeshTri2,
    material: Material,
    row: ActuatorRow,
    friction: float,
    reach: float,
    confined: bool = False,
) -> tuple[ContactProblem, FloatArray]:
    """Contact problem of a block that is fixed at its top, and the weights (n,) [mm] of its contact nodes.

    reach: nodes with |x| <= reach are candidates. confined: the sides do not move sideways.
    """
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    x, y = mesh.doflocs
    fixed = dofs[:, y == y.max()].ravel()
    if confined:
        fixed = np.union1d(fixed, dofs[0, (x == x.min()) | (x == x.max())])
    face = np.flatnonzero((y == 0.0) & (np.abs(x) <= reach))
    face = face[np.argsort(x[face])]
    vertex = np.flatnonzero(face < mesh.nvertices)
    face = face[vertex[0] : vertex[-1] + 1]  # whole elements: vertices and midpoints alternate
    matrix = stiffness(basis, [material], np.zeros(mesh.t.shape[1], dtype=int))
    compliance, _, _ = condense(matrix, dofs, fixed, face, csr_matrix((0, matrix.shape[0])))
    position = mesh.doflocs[:, face].T
    length = position[2::2, 0] - position[:-2:2, 0]
    weight = np.zeros(face.size)
    weight[1::2] = 4.0 / 6.0 * length
    weight[:-1:2] += length / 6.0
    weight[2::2] += length / 6.0
    return ContactProblem(position, compliance, row, None, friction, TOLERANCE, 10), weight


def lift(problem: ContactProblem, x: float, y: float) -> FloatArray:
    """Actuator displacements (n_actuators, 2) [mm], the same for all."""
    return np.tile([x, y], (len(problem.row.positions), 1))
