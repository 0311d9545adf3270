"""Mean stress as fields have it: exact where it is linear, and without swings near incompressibility."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from skfem import MeshTri, MeshTri2

from fingerpad.arrays import FloatArray
from fingerpad.closedforms import bending, wave
from fingerpad.fields.mean_stress import element_means, recover_linear
from fingerpad.fields.recovery import gradient_at, strain_of
from fingerpad.scene.finger import Material
from fingerpad.tissue.elasticity import displacement_basis, lame, node_dofs
from fingerpad.tissue.mesh import NODES
from scenes import section

DEVICE = "device2"


def test_what_is_linear_in_every_layer_is_recovered() -> None:
    """On the curved section, with a jump at every interface, to rounding."""
    mesh, layer = section(DEVICE).mesh, section(DEVICE).layer
    basis = displacement_basis(mesh)

    def exact(place: FloatArray) -> FloatArray:
        return 1e3 * layer[:, None] + (1.0 + layer[:, None]) * place[0] - 2.0 * place[1]

    means = element_means(basis, exact(np.asarray(basis.global_coordinates())))
    place = mesh.mapping().F(NODES)
    assert np.abs(recover_linear(basis, layer, means, place) - exact(place)).max() < 1e-12 * np.abs(means).max()


def test_patches_in_a_line_have_no_gradient_across_it() -> None:
    """Two triangles, alone in their layer, on a mesh of eight: what they know, along their line, is kept."""
    mesh = MeshTri2.from_mesh(MeshTri.init_tensor(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 2.0])))
    basis = displacement_basis(mesh)
    layer = (mesh.p[:, mesh.t].mean(axis=1) > 1.0).all(axis=0).astype(int)
    means = np.where(layer == 1, np.cumsum(layer), 0).astype(float)
    centre = mesh.p[:, mesh.t].mean(axis=1)
    found = recover_linear(basis, layer, means, centre[:, :, None])[:, 0]
    assert found == pytest.approx(means, abs=1e-13)  # but for rounding of numbers of about one


def test_the_nearer_elements_lie_the_more_they_count() -> None:
    """Each fit, solved on its own: squares over the element's area and that of the distance, to rounding."""
    mesh = MeshTri2.from_mesh(MeshTri.init_tensor(np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 5)))
    means = np.random.default_rng(0).standard_normal(mesh.nelements)
    centre = mesh.p[:, mesh.t].mean(axis=1)
    place = mesh.p[:, mesh.t.T]
    found = recover_linear(displacement_basis(mesh), np.zeros(mesh.nelements, dtype=int), means, place)
    for own in range(mesh.nelements):
        patch = np.flatnonzero(np.isin(mesh.t, mesh.t[:, own]).any(axis=0))
        apart = centre[:, patch] - centre[:, [own]]
        root = 1.0 / np.sqrt(1.0 / 32.0 + (apart**2).sum(axis=0))  # each of the 32 elements has that area
        middle, *slope = np.linalg.lstsq((np.stack([np.ones(patch.size), *apart]) * root).T, root * means[patch])[0]
        expected = middle + np.array(slope) @ (place[:, own] - centre[:, [own]])
        assert found[own] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("poisson", bending.RATIOS)
def test_bent_tissue_has_no_swings(poisson: float) -> None:
    """A bent block: at all corners and midpoints within 1 % of the largest mean stress, though at 0.4999 the elements'
    own points are wrong by a fifth.

    Means over elements are good to 0.6 %, the linear fits add the curvature of a stress over two elements of 32.
    """
    found = bending.bend(poisson, bending.DIVISIONS[-1])
    exact = bending.Sector(found.material, bending.STRAIN)
    place = found.basis.mesh.mapping().F(NODES)
    wanted = exact.mean_stress(place[0])
    assert np.abs(found.recovered(place) - wanted).max() < 0.01 * np.abs(wanted).max()
    own = exact.mean_stress(np.asarray(found.basis.global_coordinates())[0])
    assert element_means(found.basis, found.mean_stress) == pytest.approx(
        element_means(found.basis, own), abs=0.01 * np.abs(wanted).max()
    )
    if poisson == max(bending.RATIOS):
        assert np.abs(found.mean_stress - own).max() > 0.2 * np.abs(wanted).max()


def test_recovered_stress_does_not_know_poissons_ratio() -> None:
    """Small strain, where the exact mean stress does not: errors are the same to a third from 0.3 to 0.4999, while
    at 0.4999 what points of elements say is off by more than half the pressure.
    """
    common, *others = (wave.wave(poisson, wave.DIVISIONS[-1])[0].error for poisson in (0.3, 0.48, 0.49, 0.499, 0.4999))
    assert others == pytest.approx([common] * len(others), rel=1 / 3)
    material, line = Material(1.0, 0.4999), np.linspace(0.0, wave.SIDE, wave.DIVISIONS[-1] + 1)
    basis = displacement_basis(MeshTri2.from_mesh(MeshTri.init_tensor(line, line)))
    moved = wave.computed_displacement(basis, material)[node_dofs(basis)]
    dilatation = strain_of(gradient_at(basis.mesh, moved, NODES))[:, :2].sum(axis=1)
    exact = wave.mean_stress(basis.mesh.mapping().F(NODES)).ravel()
    assert np.abs(sum(lame(material)) * dilatation - exact).max() > 0.5


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.4999])
def test_the_wave_is_in_equilibrium(poisson: float) -> None:
    """The closed form itself: its strain has the mean stress, the face's pressure without shear, and no force inside.

    Differences over h are off by h^2 / 6 times third derivatives, which of k y exp(-k y) are 3 k^3: by (k h)^2 / 2 of
    strains, and lambda + 2 mu times that of stress; of the gradient of a stress of one by (k h)^2 / 2 of k.
    """
    material, small, large = Material(1.0, poisson), 1e-5, 1e-2  # mm
    lam, mu = lame(material)
    strain = 1.0 / (2.0 * mu)  # under a pressure of one
    off = (lam + 2.0 * mu) * strain * (wave.NUMBER * small) ** 2 / 2.0

    def stress_at(x: float, y: float) -> FloatArray:
        along, down = slopes(lambda *at: wave.displacement(material, np.array(at)), x, y, small)
        volume = lam * (along[0] + down[1])
        return np.array([volume + 2 * mu * along[0], volume + 2 * mu * down[1], mu * (along[1] + down[0])])

    place = 0.3, 0.4  # mm
    sxx, syy, _ = stress_at(*place)
    assert (sxx + syy) / 2.0 == pytest.approx(wave.mean_stress(np.array(place)), abs=off)
    assert stress_at(0.3, 0.0)[1:] == pytest.approx([-np.cos(wave.NUMBER * 0.3), 0.0], abs=off)
    along, down = slopes(stress_at, *place, large)
    assert np.abs([along[0] + down[2], along[2] + down[1]]).max() < wave.NUMBER * (wave.NUMBER * large) ** 2 / 2.0


def slopes(of: Callable[[float, float], FloatArray], x: float, y: float, step: float) -> tuple[FloatArray, FloatArray]:
    """Derivatives along x and y, by central differences."""
    return (of(x + step, y) - of(x - step, y)) / (2.0 * step), (of(x, y + step) - of(x, y - step)) / (2.0 * step)
