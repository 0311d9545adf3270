"""Recovery of the section's full fields from contact forces."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis

from .condensation import contact_tractions, section_stiffness
from .elasticity import displacement_basis, node_dofs
from .fields import Fields
from .mesh import SectionMesh
from .scene import FloatArray, Scene
from .strain import maximum_principal

CORNERS = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])  # of the reference triangle


def recover_fields(section: SectionMesh, scene: Scene, forces: FloatArray) -> Fields:
    """Fields under contact forces (n_loadings, n_contact, 2) [N/mm]: K u = f, one factorisation for all."""
    matrix, dofs = section_stiffness(section, scene)
    free = np.setdiff1d(np.arange(matrix.shape[0]), dofs[:, section.fixed].ravel())
    tractions = contact_tractions(section, scene)
    right = np.zeros((matrix.shape[0], forces.shape[0]))
    right[dofs[:, tractions.nodes].T.ravel()] = tractions.by_component() @ forces.reshape(forces.shape[0], -1).T
    factors = splu(
        csc_matrix(matrix[free][:, free]),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    displacement = np.zeros_like(right)
    displacement[free] = factors.solve(right[free])

    basis = displacement_basis(section.mesh)
    corner = section.mesh.doflocs[:, section.mesh.t.T.ravel()]
    at_corners = Basis(section.mesh, basis.elem, quadrature=(CORNERS, np.ones(3)))
    nodes = node_dofs(basis)[:, section.mesh.t.T.ravel()]
    strains = []
    for column in displacement.T:
        gradient = np.asarray(at_corners.interpolate(column).grad)
        components = np.stack([gradient[0, 0], gradient[1, 1], gradient[0, 1] + gradient[1, 0]], axis=-1)
        strains.append(maximum_principal(components.ravel()))
    one_of = np.empty(section.mesh.nvertices, dtype=np.int64)  # of the corners at a vertex, which move together
    one_of[section.mesh.t.T.ravel()] = np.arange(corner.shape[1])
    interface, boundary = (
        one_of[section.mesh.facets[:, facets].T] for facets in (section.interfaces(), section.mesh.boundary_facets())
    )
    moved = np.array([column[nodes] for column in displacement.T])
    return Fields(corner, interface, boundary, moved, np.array(strains))
