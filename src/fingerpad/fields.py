"""Full displacement and strain fields of the section, for the figures that draw them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis

from .condensation import contact_tractions, section_stiffness
from .elasticity import displacement_basis, node_dofs
from .mesh import SectionMesh
from .scene import FloatArray, Scene
from .strain import maximum_principal

CORNERS = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])  # of the reference triangle


@dataclass(frozen=True)
class Fields:
    """Fields of several loadings, on triangles of their own (strain jumps between elements).

    corner: (2, 3 n_elements) undeformed corners [mm], three an element. layer: (n_elements,). displacement:
    (n_loadings, 2, 3 n_elements) [mm]. strain: (n_loadings, 3 n_elements) maximum principal strain [1].
    """

    corner: FloatArray
    layer: np.ndarray
    displacement: FloatArray
    strain: FloatArray


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
    return Fields(corner, section.layer, np.array([column[nodes] for column in displacement.T]), np.array(strains))
