"""Elastic blocks on which closed forms are computed, and their contact problems: the touched face lies on y = 0."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from skfem import MeshTri, MeshTri2

from ..arrays import FloatArray
from ..contact.formulation import ContactProblem, ContactState, rest, touching_height
from ..contact.path import follow
from ..scene.device import ActuatorRow
from ..scene.finger import Material
from ..tissue.compliance import MIRROR
from ..tissue.condensation import condense
from ..tissue.elasticity import displacement_basis, node_dofs, stiffness, unit_loads
from ..tissue.mesh import SIZE_SLACK
from ..tissue.traction import linear_tractions

TOLERANCE = 1e-10  # of the contact equations [1]; source: far below any error that is measured
TISSUE, NEAR_LIMIT = 0.48, 0.4999  # Poisson's ratios [1]: of skin (config/config.yaml), and towards incompressibility
MAX_CUTS = 10  # halvings of an increment [1]; source: config/config.yaml
GROWTH = 0.5  # of element size with distance [1]; source: 0.25 changes pressures and stick zones by less than 1e-3
HALF_WIDTH = 1.0  # of contact on a half-plane [mm]
# The surface strain that a half-plane's boundary sends back is of the order of the half-width over its distance, and
# partial slip feels it: at 100 half-widths a stick zone is 5 % too wide (measured).
FAR = 4096.0 * HALF_WIDTH  # to a half-plane's boundary [mm]; a power of two, so that halving meets the contact's edge
REACH = 1.125 * HALF_WIDTH  # of contact nodes [mm]; source: contact ends at its half-width
DIAGONAL = np.sqrt(2.0)  # longest edge of a triangle over its legs [1]


@dataclass(frozen=True)
class Block:
    """A block in contact: the problem, length of face (n,) [mm] that belongs to each contact node, unknowns [1]."""

    problem: ContactProblem
    weight: FloatArray
    unknowns: int


def block_mesh(x: FloatArray, y: FloatArray) -> MeshTri2:
    """Second-order triangles on a tensor grid from x = 0, and their mirror image at x < 0; x and y ascending."""
    return _mirrored(MeshTri.init_tensor(x, y))


def _half_plane_mesh(spacing: float, edge_spacing: float) -> MeshTri2:
    """Mesh of a half-plane: a block so large that its boundary does not matter.

    Elements on the face are at most `spacing` [mm] long in contact and at most `edge_spacing` at its edges,
    x = +-HALF_WIDTH, which are vertices; they grow from there.
    """

    def size(x: FloatArray, y: FloatArray) -> FloatArray:
        to_face = np.hypot(np.maximum(x - HALF_WIDTH, 0.0), y)
        to_edge = np.hypot(x - HALF_WIDTH, y)
        return np.minimum(spacing + GROWTH * to_face, edge_spacing + GROWTH * to_edge)

    return refined_block(np.array([0.0, FAR]), np.array([0.0, FAR]), size)


def refined_block(x: FloatArray, y: FloatArray, size: Callable[[FloatArray, FloatArray], FloatArray]) -> MeshTri2:
    """Second-order triangles that keep the lines of a tensor grid from x = 0, and their mirror image at x < 0.

    Triangles are halved until their legs are at most `size` (n,) [mm] at their centres x, y (n,) [mm].
    """
    half = MeshTri.init_tensor(x, y)
    while True:
        corners = half.p[:, half.t]
        longest = np.max(np.hypot(*(corners - np.roll(corners, 1, axis=1))), axis=0)
        marked = np.flatnonzero(longest > DIAGONAL * size(*corners.mean(axis=1)) * (1.0 + SIZE_SLACK))
        if marked.size == 0:
            return _mirrored(half)
        half = half.refined(marked)


def _mirrored(half: MeshTri) -> MeshTri2:
    """The mesh at x >= 0 together with its mirror image, diagonals included, second-order."""
    return MeshTri2.from_mesh(half + MeshTri(half.p * MIRROR[:, None], half.t))


def block_contact(
    mesh: MeshTri2, material: Material, row: ActuatorRow, friction: float, reach: float, confined: bool = False
) -> Block:
    """Contact problem of a block that is fixed at its top.

    reach: elements with |x| < reach [mm] may come into contact. confined: the sides do not move sideways.
    """
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    x, y = mesh.doflocs
    fixed = dofs[:, y == y.max()].ravel()
    if confined:
        fixed = np.union1d(fixed, dofs[0, (x == x.min()) | (x == x.max())])
    face = np.flatnonzero(y == 0.0)
    face = face[np.argsort(x[face])]
    tractions = linear_tractions(face, mesh.doflocs[:, face], np.abs(x[face[1::2]]) < reach)
    matrix = stiffness(basis, [material], np.zeros(mesh.t.shape[1], dtype=int))
    loads = csc_matrix(unit_loads(dofs, tractions.nodes, matrix.shape[0]) @ tractions.by_component())
    compliance = condense(matrix, dofs, fixed, loads, csr_matrix((0, matrix.shape[0]))).compliance
    problem = ContactProblem(
        position=tractions.position,
        compliance=compliance,
        row=row,
        body=None,
        friction=friction,
        tolerance=TOLERANCE,
        max_cuts=MAX_CUTS,
    )
    return Block(problem, tractions.weight, int(basis.N))


def half_plane(spacing: float, edge_spacing: float, poisson: float, row: ActuatorRow, friction: float) -> Block:
    """Contact problem of a half-plane of modulus 1 MPa, touched over about 2 HALF_WIDTH."""
    return block_contact(_half_plane_mesh(spacing, edge_spacing), Material(1.0, poisson), row, friction, REACH)


def face_means(block: Block, traction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Middles (m,) [mm] of the face's elements, and means (m,) over each of a traction that is linear (n,)."""
    x = block.problem.position[:, 0]
    return (x[:-1] + x[1:]) / 2.0, (traction[:-1] + traction[1:]) / 2.0


def lift(problem: ContactProblem, x: float, y: float) -> FloatArray:
    """Actuator displacements (n_actuators, 2) [mm], the same for all."""
    return np.tile([x, y], (len(problem.row.positions), 1))


def pressed(problem: ContactProblem, depth: float, increments: int) -> ContactState:
    """State after pressing by `depth` [mm] from first touch."""
    height = touching_height(problem)
    return follow(problem, rest(problem, height), lift(problem, 0.0, height + depth), increments)
