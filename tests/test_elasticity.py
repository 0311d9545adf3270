"""The strain read-out (patch test, manufactured solution, incompressibility: test_closedforms.py)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.closedforms.blocks import block_mesh
from fingerpad.closedforms.equilibrium import linear_equilibrium
from fingerpad.errors import SceneError
from fingerpad.scene.finger import Material
from fingerpad.scene.readout import Side
from fingerpad.tissue.elasticity import displacement_basis, facet_strain, mesh_dofs, node_dofs, stiffness
from fingerpad.tissue.mesh import element_nodes, nominal_mesh
from fingerpad.tissue.receptors import receptor_strain
from scenes import scene


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


@pytest.mark.parametrize("side", Side)
def test_receptors_lie_in_elements_of_the_side_they_are_read_on(side: Side) -> None:
    """What moves where that layer does not reach strains none of them; its own nodes strain every one."""
    base = scene("device2").coarsened(4.0)
    base = base.with_model(readout=replace(base.model.readout, side=side))
    section = nominal_mesh(base)
    own = np.unique(element_nodes(section.mesh)[section.layer == base.model.receptor_layer(side)])
    others = np.setdiff1d(np.arange(section.mesh.doflocs.shape[1]), own)
    _, strain = receptor_strain(section, base)
    for nodes, strained in ((own, True), (others, False)):
        field = np.zeros(strain.shape[1])
        field[mesh_dofs(section.mesh)[:, nodes]] = np.random.default_rng(0).standard_normal((2, nodes.size))
        assert np.all((strain @ field).reshape(-1, 3).any(axis=1) == strained)


@pytest.mark.parametrize("poisson", [-1.0, 0.5])
def test_tissue_that_has_no_stiffness_to_compute_with_is_refused(poisson: float) -> None:
    """At either end of Poisson's ratio one of Lamé's constants is infinite."""
    Material(1.0, 0.999 * poisson)
    with pytest.raises(SceneError, match=r"poisson must lie between -1 and 0\.5"):
        Material(1.0, poisson)
