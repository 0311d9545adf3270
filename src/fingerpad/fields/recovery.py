"""Recovery of the whole section's displacement from contact forces on linear tissue, and its gradient."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix
from skfem import MeshTri2

from ..arrays import FloatArray
from ..scene.scene import Scene
from ..tissue.condensation import section_stiffness
from ..tissue.elasticity import displacement_basis, mesh_dofs, node_dofs
from ..tissue.factors import factorise, fill_reducing_order
from ..tissue.mesh import SectionMesh
from ..tissue.reach import contact_tractions


def recover_displacement(section: SectionMesh, scene: Scene, forces: FloatArray) -> FloatArray:
    """Displacement (n_loadings, 2, n_nodes) [mm] of all nodes under contact forces (n_loadings, n_contact, 2) [N/mm].

    K u = f, one factorisation for all loadings. Raises CondensationError if K is singular, MeshError as
    `contact_tractions`.
    """
    matrix, dofs = section_stiffness(section, scene), mesh_dofs(section.mesh)
    order = fill_reducing_order(matrix, dofs, dofs[:, section.fixed].ravel())
    tractions = contact_tractions(section, scene)
    right = np.zeros((matrix.shape[0], forces.shape[0]))
    right[dofs[:, tractions.nodes].T.ravel()] = tractions.by_component() @ forces.reshape(forces.shape[0], -1).T
    displacement = np.zeros_like(right)
    displacement[order] = factorise(csc_matrix(matrix[order][:, order])).solve(right[order])
    return displacement.T[:, dofs]


def gradient_at(mesh: MeshTri2, displacement: FloatArray, points: FloatArray) -> FloatArray:
    """Displacement gradient (2, 2, n_elements k) [1], du_i/dX_j, at reference points (2, k) of every element, one
    element after the other. displacement: (2, n_nodes) [mm].
    """
    basis = displacement_basis(mesh, points=(points, np.ones(points.shape[1])))
    unknowns = np.empty(basis.N)
    unknowns[node_dofs(basis)] = displacement
    return np.asarray(basis.interpolate(unknowns).grad).reshape(2, 2, -1)


def strain_of(gradient: FloatArray) -> FloatArray:
    """Strain (n, 3) [1], exx, eyy, gxy, of displacement gradients (2, 2, n)."""
    return np.stack([gradient[0, 0], gradient[1, 1], gradient[0, 1] + gradient[1, 0]], axis=-1)
