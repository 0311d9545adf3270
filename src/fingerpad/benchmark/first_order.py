"""First-order elements on the same triangles, to measure against: what the order of elements is worth.

Displacements that are linear between vertices are second-order ones whose nodes between two vertices move by the mean
of both, u = T v. So stiffness and loads are T^T K T and T^T L, and strain is read from T v.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from skfem import MeshTri2

from ..prediction.scoring import Condensed, condensed_of
from ..scene.scene import Scene
from ..tissue.condensation import condense_parts, section_stiffness
from ..tissue.halves import right_half
from ..tissue.mesh import SectionMesh
from ..tissue.reach import contact_tractions


def condense_first_order(scene: Scene, mesh: SectionMesh) -> Condensed:
    """`scoring.condense_mesh` with first-order displacements; outlines and layers stay curved.

    Raises MeshError, CondensationError.
    """
    tractions = contact_tractions(mesh, scene)
    parts = right_half(mesh, tractions)
    matrix = section_stiffness(mesh, scene, parts.elements)
    nodal = _linear(mesh.mesh, parts.dofs)
    between = parts.dofs[:, mesh.mesh.nvertices :]
    first = replace(
        parts,
        held=[np.union1d(held, between) for held in parts.held],
        loads=[csc_matrix(nodal.T @ loads) for loads in parts.loads],
    )
    section = condense_parts(mesh, scene, tractions, first, csc_matrix(nodal.T @ matrix @ nodal), nodal)
    return condensed_of(scene, section)


def _linear(mesh: MeshTri2, dofs: np.ndarray) -> csr_matrix:
    """T (n_unknowns, n_unknowns): displacements of all nodes by those of the vertices. dofs: (2, n_nodes)."""
    vertices = dofs[:, : mesh.nvertices].ravel()
    between = np.tile(dofs[:, mesh.nvertices :], 2).ravel()
    ends = dofs[:, mesh.facets.ravel()].ravel()
    rows, columns = np.concatenate([vertices, between]), np.concatenate([vertices, ends])
    shares = np.concatenate([np.ones(vertices.size), np.full(between.size, 0.5)])
    return csr_matrix((shares, (rows, columns)), shape=(dofs.size, dofs.size))
