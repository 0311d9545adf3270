"""The strain read-out (patch test, manufactured solution, incompressibility: test_closedforms.py)."""

from __future__ import annotations

import numpy as np

from fingerpad.closedforms.blocks import block_mesh
from fingerpad.closedforms.equilibrium import linear_equilibrium
from fingerpad.scene.finger import Material
from fingerpad.tissue.elasticity import displacement_basis, facet_strain, node_dofs, stiffness


def test_facet_strain_reads_the_side_that_is_asked_for() -> None:
    """Across an interface of two materials the normal strain jumps; each side reads its own."""
    mesh = block_mesh(np.linspace(0, 1, 3), np.linspace(0, 2, 5))
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    upper = mesh.p[1, mesh.t].mean(axis=0) > 1.0
    matrix = stiffness(basis, [Material(1.0, 0.0), Material(3.0, 0.0)], upper.astype(int))
    y = mesh.doflocs[1]
    field = np.zeros(basis.N)
    field[dofs[1, y == 2.0]] = 0.04
    held = np.concatenate([dofs[:, (y == 0.0) | (y == 2.0)].ravel(), dofs[0]])
    field = linear_equilibrium(matrix, held, field, np.zeros(basis.N))
    interface = np.flatnonzero(np.all(mesh.p[1, mesh.facets] == 1.0, axis=0))
    for material, expected in ((False, 0.03), (True, 0.01)):  # equal stress: strain in ratio 3 : 1, together 0.04 / 1
        adjacent = mesh.f2t[:, interface]
        element = np.where(upper[adjacent[0]] == material, adjacent[0], adjacent[1])
        _, strain = facet_strain(mesh, interface, element)
        assert np.abs((strain @ field).reshape(-1, 3)[:, 1] - expected).max() < 1e-12
