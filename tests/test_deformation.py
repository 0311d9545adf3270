"""Internal forces and tangent of deformed tissue on the finger's section (closed forms: test_closedforms.py)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from scipy.sparse import csc_matrix
from skfem import Basis
from skfem.helpers import grad

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.energy import STEP, stored_energy
from fingerpad.closedforms.finite_manufactured import large_displacement
from fingerpad.closedforms.manufactured import uniform
from fingerpad.errors import InvertedError
from fingerpad.finite.deformation import Elements, elements_of, internal_force, tangent_stiffness
from fingerpad.finite.hyperelasticity import Tissue, tissue_of
from fingerpad.scene.tissue_law import Law
from fingerpad.tissue.elasticity import displacement_basis, node_dofs, stiffness
from fingerpad.tissue.mesh import nominal_mesh
from forms import LAWS, forms
from scenes import scene

SPACING = 1.6  # mm: some hundred elements, curved, of all layers
EXPONENT = 3.0  # of Ogden's law
ROUNDING = 1e-12  # relative
DIFFERENCE = 1e-4  # mm; central differences are off by its square, 1e-8, times third derivatives over first ones, and
DIFFERENCES = 1e-7  # by rounding over it, 1e-12

everywhere = pytest.mark.parametrize("law", Law)


@dataclass(frozen=True)
class Section:
    """The whole section under one law: a third of its unknowns is held, the others stand in any order."""

    basis: Basis
    dofs: np.ndarray
    place: FloatArray
    tissue: Tissue
    elements: Elements
    linear: csc_matrix


@cache
def section(law: Law) -> Section:
    coarse = uniform(scene("device2"), SPACING)
    mesh = nominal_mesh(coarse)
    finger = coarse.model.finger
    materials = [layer.material for layer in finger.layers]
    basis = displacement_basis(mesh.mesh)
    tissue = tissue_of(law, EXPONENT, materials, mesh.layer[:, None])
    mixed = np.random.default_rng(1).permutation(basis.N)
    elements = elements_of(basis, tissue, mixed[: 2 * basis.N // 3])
    linear = stiffness(basis, materials, mesh.layer)
    return Section(basis, node_dofs(basis), mesh.mesh.doflocs, tissue, elements, linear)


def deformed(own: Section) -> FloatArray:
    """A displacement (size,) [mm] of large strains, large rotations and no smoothness."""
    field = 0.005 * np.random.default_rng(2).standard_normal(own.basis.N)
    field[own.dofs] += large_displacement(own.place)
    return field


def directions(own: Section) -> FloatArray:
    """Random changes of displacement (3, size)."""
    return np.random.default_rng(3).standard_normal((3, own.basis.N))


@everywhere
def test_force_is_the_derivative_of_the_energy(law: Law) -> None:
    """f . v is the complex step of int W(H(u + i h v)) dA; gradients and integral are scikit-fem's."""
    own = section(law)
    field = deformed(own)
    force = internal_force(own.elements, field)
    gradient = np.asarray(grad(own.basis.interpolate(field)))
    for direction in directions(own):
        change = np.asarray(grad(own.basis.interpolate(direction)))
        energy = (stored_energy(own.tissue, gradient + 1j * STEP * change) * own.basis.dx).sum()
        assert abs(force @ direction - energy.imag / STEP) < ROUNDING * np.abs(force * direction).sum()


@everywhere
def test_tangent_is_the_derivative_of_the_force(law: Law) -> None:
    """On the free unknowns, whose order is arbitrary; symmetric."""
    own = section(law)
    field, free = deformed(own), own.elements.free
    tangent = tangent_stiffness(own.elements, field)
    assert np.abs(tangent - tangent.T).max() < 1e-14 * np.abs(tangent).max()
    for direction in directions(own):
        held = direction.copy()
        held[np.setdiff1d(np.arange(own.basis.N), free)] = 0.0
        one, two = (
            (internal_force(own.elements, field + t * held) - internal_force(own.elements, field - t * held))
            / (2.0 * t)
            for t in (DIFFERENCE / 2.0, DIFFERENCE)
        )
        found = tangent @ held[free]
        assert np.linalg.norm(((4.0 * one - two) / 3.0)[free] - found) < DIFFERENCES * np.linalg.norm(found)


@pytest.mark.parametrize("law", LAWS)
def test_scikit_fem_assembles_the_same(law: Law) -> None:
    """Forces and tangent of the same law, written in tensors and assembled by scikit-fem's own loops."""
    own = section(law)
    field, free = deformed(own), own.elements.free
    force, tangent = internal_force(own.elements, field), tangent_stiffness(own.elements, field)
    points = np.ones(own.basis.dx.shape)
    given = {"state": own.basis.interpolate(field), "lam": own.tissue.lam * points, "mu": own.tissue.mu * points}
    work, stiffness_form = forms(law)
    wanted, stiff = work.assemble(own.basis, **given), csc_matrix(stiffness_form.assemble(own.basis, **given))
    assert np.abs(force - wanted).max() < ROUNDING * np.abs(wanted).max()
    assert np.abs(tangent - stiff[free][:, free]).max() < ROUNDING * np.abs(stiff).max()


@everywhere
def test_undeformed_tissue_is_linear_elastic(law: Law) -> None:
    """No force, and the stiffness of `elasticity` to rounding: the small mode is the tangent at rest."""
    own = section(law)
    rest = np.zeros(own.basis.N)
    force, tangent = internal_force(own.elements, rest), tangent_stiffness(own.elements, rest)
    assert np.array_equal(force, rest)
    wanted = own.linear[own.elements.free][:, own.elements.free]
    assert np.abs(tangent - wanted).max() < 1e-14 * np.abs(wanted).max()


@everywhere
def test_small_displacements_are_linear(law: Law) -> None:
    """The force differs from the linear one by a part that falls with the displacement: a tenth for a tenth. The next
    order is as much smaller as gradients are small, which are 1e-3 and 1e-4 (measured: 6e-5 and 6e-6).
    """
    own = section(law)
    field = np.zeros(own.basis.N)
    field[own.dofs] = large_displacement(own.place)
    apart = []
    for scale in (1e-3, 1e-4, 1e-5):
        linear = own.linear @ (scale * field)
        apart.append(np.linalg.norm(internal_force(own.elements, scale * field) - linear) / np.linalg.norm(linear))
    assert apart[0] < 0.01
    assert apart[0] / apart[1] == pytest.approx(10.0, rel=5e-4)
    assert apart[1] / apart[2] == pytest.approx(10.0, rel=5e-5)


@everywhere
def test_rigid_motion_needs_no_force(law: Law) -> None:
    """Turned by 2 rad and carried off: no force, where the linear model has plenty; and the tangent turns along."""
    own = section(law)
    rotation = np.array([[np.cos(2.0), -np.sin(2.0)], [np.sin(2.0), np.cos(2.0)]])
    field = np.zeros(own.basis.N)
    field[own.dofs] = rotation @ own.place - own.place + np.array([[3.0], [-7.0]])
    everything = elements_of(own.basis, own.tissue, np.arange(own.basis.N))
    force, tangent = internal_force(everything, field), tangent_stiffness(everything, field)
    assert np.abs(force).max() < ROUNDING * np.abs(own.linear @ field).max()
    rows, columns = (np.repeat(own.dofs, 2, axis=0), np.vstack([own.dofs, own.dofs]))
    entries = np.repeat(rotation.ravel(), own.dofs.shape[1])
    turning = csc_matrix((entries, (rows.ravel(), columns.ravel())))
    wanted = turning @ own.linear @ turning.T
    assert np.abs(tangent - wanted).max() < ROUNDING * np.abs(wanted).max()


@everywhere
def test_forces_turn_with_the_scene(law: Law) -> None:
    """Objectivity of a deformed section: turn all of it, and the forces turn. They have no sum and no moment."""
    own = section(law)
    field = deformed(own)
    force = internal_force(own.elements, field)[own.dofs]
    place = own.place + field[own.dofs]
    rotation = np.array([[0.0, -1.0], [1.0, 0.0]])
    turned = np.zeros(own.basis.N)
    turned[own.dofs] = rotation @ place - own.place
    scale = np.abs(force).sum()
    assert np.abs(internal_force(own.elements, turned)[own.dofs] - rotation @ force).max() < ROUNDING * scale
    assert np.abs(force.sum(axis=1)).max() < ROUNDING * scale
    moment = place[0] * force[1] - place[1] * force[0]
    assert abs(moment.sum()) < ROUNDING * np.abs(moment).sum()


def test_a_node_pulled_through_its_elements_is_an_error() -> None:
    """It names how many elements, no more than the node has, and the place of one of them."""
    own = section(Law.HENCKY)
    node = int(own.basis.mesh.t[0, 7])
    field = np.zeros(own.basis.N)
    field[own.dofs[0, node]] = 5.0
    around = (own.basis.mesh.t[:3] == node).any(axis=0)
    for function in (internal_force, tangent_stiffness):
        with pytest.raises(InvertedError) as caught:
            function(own.elements, field)
        said = re.fullmatch(r".* in (\d+) elements, the first at x, y = (\S+), (\S+) mm", str(caught.value))
        assert said
        assert 0 < int(said[1]) <= np.count_nonzero(around)
        place = np.array([float(said[2]), float(said[3])])
        assert np.abs(own.elements.centre[around] - place).max(axis=1).min() < 1e-3
