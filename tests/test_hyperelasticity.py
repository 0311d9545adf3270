"""Laws of tissue that deforms much, against energies written in the deformation gradient alone (closedforms.energy)."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import logm

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.energy import first_stress, stored_energy
from fingerpad.finite.finite_strain import green_strain, is_upright, logarithmic_strain
from fingerpad.finite.hyperelasticity import EQUAL, Tissue, cauchy_stress, respond, tissue_of
from fingerpad.scene.finger import Material
from fingerpad.scene.tissue_law import Law
from fingerpad.tissue.elasticity import lame

MATERIALS = [Material(0.08, 0.48), Material(1.0, 0.3), Material(2.0, 0.0)]
EXPONENT = 9.0  # of Ogden's law, where it matters
ROUNDING = 1e-12  # relative; some thousand units of rounding: Ogden's law takes ninth powers
STEP = 1e-4  # of differences of fourth order, whose error is its fourth power or rounding over it: 1e-12
DIFFERENCES = 1e-8  # relative: differences of Ogden's law, whose fifth derivatives have factors of 9^4
SHEARS = np.array([0.01, 0.3, 1.0])

everywhere = pytest.mark.parametrize("law", Law)


def tissue(law: Law, count: int) -> Tissue:
    """Tissue at `count` points, each material in turn."""
    return tissue_of(law, EXPONENT, MATERIALS, np.arange(count) % len(MATERIALS))


def turn(angle: float) -> FloatArray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def gradients() -> FloatArray:
    """Displacement gradients (2, 2, n): random ones, ones with (nearly) equal principal stretches, and rest."""
    random = np.random.default_rng(5)
    found = [0.25 * random.standard_normal((2, 2)) for _ in range(60)]
    for stretch in (0.8, 1.0, 1.3):
        for noise in (0.0, 1e-14, 1e-9, 0.3 * EQUAL, 3.0 * EQUAL, 1e-4):
            skew = noise * random.standard_normal((2, 2))
            found += [stretch * np.eye(2) + skew - np.eye(2), turn(2.0) @ (stretch * np.eye(2) + skew) - np.eye(2)]
    chosen = np.stack(found, axis=-1)
    return chosen[..., determinant(chosen) > 0.2]


def determinant(gradient: FloatArray) -> FloatArray:
    (a, b), (c, d) = gradient
    return np.asarray((1.0 + a) * (1.0 + d) - b * c)


def deformation(gradient: FloatArray) -> FloatArray:
    return gradient + np.eye(2)[..., None]


def tensor(voigt: FloatArray) -> FloatArray:
    """Stress (2, 2, n) of S_11, S_22, S_12 (3, n)."""
    return np.array([[voigt[0], voigt[2]], [voigt[2], voigt[1]]])


def test_gradients_hold_what_they_are_meant_to() -> None:
    """Exactly equal principal strains, ones on both sides of EQUAL, and well separated ones."""
    strain = green_strain(gradients())
    apart = 2.0 * np.hypot((strain[0] - strain[1]) / 2.0, strain[2] / 2.0)
    assert np.count_nonzero(apart == 0.0) >= 3
    assert np.count_nonzero((apart > 0.0) & (apart < EQUAL)) >= 3
    assert np.count_nonzero((apart > EQUAL) & (apart < 100.0 * EQUAL)) >= 3
    assert np.count_nonzero(apart > 0.1) >= 30


@everywhere
def test_stress_is_the_derivative_of_the_energy(law: Law) -> None:
    """F S = dW/dF, by the complex step: to rounding, also where principal stretches are equal."""
    chosen = gradients()
    own = tissue(law, chosen.shape[-1])
    found = np.einsum("ikn,kjn->ijn", deformation(chosen), tensor(respond(own, chosen).stress))
    wanted = first_stress(own, chosen)
    scale = np.maximum(np.abs(wanted).max(axis=(0, 1)), own.mu + own.lam)
    assert (np.abs(found - wanted).max(axis=(0, 1)) / scale).max() < ROUNDING


@everywhere
def test_tangent_is_the_derivative_of_the_stress(law: Law) -> None:
    """dS = D dE along random changes of the gradient, with dE = sym(F^T dF)."""
    chosen = gradients()
    own = tissue(law, chosen.shape[-1])
    tangent = respond(own, chosen).tangent
    assert np.abs(tangent - np.swapaxes(tangent, 0, 1)).max() <= 1e-14 * np.abs(tangent).max()
    random = np.random.default_rng(6)
    for _ in range(4):
        change = random.standard_normal(chosen.shape)
        one, two = (
            (respond(own, chosen + step * change).stress - respond(own, chosen - step * change).stress) / (2.0 * step)
            for step in (STEP, 2.0 * STEP)
        )
        strain = np.einsum("kin,kjn->ijn", deformation(chosen), change)
        voigt = np.array([strain[0, 0], strain[1, 1], strain[0, 1] + strain[1, 0]])
        error = np.abs((4.0 * one - two) / 3.0 - np.einsum("ijn,jn->in", tangent, voigt)).max(axis=0)
        assert (error / np.abs(tangent).max(axis=(0, 1))).max() < DIFFERENCES


@everywhere
def test_zero_strain_is_linear_elasticity(law: Law) -> None:
    """No stress, and the stiffness of `elasticity`, at rest and after a mere turn."""
    for angle in (0.0, 1.1):
        gradient = np.repeat((turn(angle) - np.eye(2))[..., None], len(MATERIALS), axis=-1)
        response = respond(tissue(law, len(MATERIALS)), gradient)
        for number, (lam, mu) in enumerate(lame(material) for material in MATERIALS):
            linear = np.array([[lam + 2.0 * mu, lam, 0.0], [lam, lam + 2.0 * mu, 0.0], [0.0, 0.0, mu]])
            assert np.abs(response.tangent[..., number] - linear).max() < 1e-13 * linear.max()
            assert np.abs(response.stress[:, number]).max() < 1e-14 * linear.max()


@everywhere
def test_cauchy_stress_is_that_of_the_energy(law: Law) -> None:
    """P F^T / J in the plane, with P from the energy; turned in space it turns along, and zz does not."""
    chosen = gradients()
    own, rotation, unit = tissue(law, chosen.shape[-1]), turn(0.9), np.eye(2)[..., None]
    found = cauchy_stress(own, chosen)
    wanted = np.einsum("ikn,jkn->ijn", first_stress(own, chosen), deformation(chosen)) / determinant(chosen)
    scale = np.maximum(np.abs(wanted).max(axis=(0, 1)), own.mu + own.lam)
    plane = tensor(found[[0, 1, 3]])
    assert (np.abs(plane - wanted).max(axis=(0, 1)) / scale).max() < ROUNDING
    turned = cauchy_stress(own, np.einsum("ik,kjn->ijn", rotation, deformation(chosen)) - unit)
    spun = np.einsum("ik,kln,jl->ijn", rotation, plane, rotation)
    assert (np.abs(tensor(turned[[0, 1, 3]]) - spun).max(axis=(0, 1)) / scale).max() < ROUNDING
    assert (np.abs(turned[2] - found[2]) / scale).max() < ROUNDING


@everywhere
def test_stress_out_of_the_plane_is_that_of_any_unstrained_axis(law: Law) -> None:
    """Stretched along x alone, y and z are alike."""
    stretch = np.zeros((2, 2, 9))
    stretch[0, 0] = np.linspace(-0.4, 0.8, 9)
    own = tissue(law, 9)
    _, yy, zz, _ = cauchy_stress(own, stretch)
    assert np.abs(yy - zz).max() < ROUNDING * np.abs(yy).max()


@everywhere
def test_laws_do_not_see_rotations(law: Law) -> None:
    """Turned in space: the same S, tangent and logarithmic strain. Turned before: isotropic, so S turns with it."""
    chosen = gradients()
    own = tissue(law, chosen.shape[-1])
    rotation, unit = turn(0.9), np.eye(2)[..., None]
    turned = np.einsum("ik,kjn->ijn", rotation, deformation(chosen)) - unit
    here, there = respond(own, chosen), respond(own, turned)
    stiff = np.abs(here.tangent).max(axis=(0, 1))
    assert (np.abs(there.stress - here.stress).max(axis=0) / stiff).max() < ROUNDING
    # where principal stretches are nearly equal, rounding of their axes meets rounding over their distance
    assert (np.abs(there.tangent - here.tangent).max(axis=(0, 1)) / stiff).max() < 1e-8
    assert np.abs(logarithmic_strain(turned) - logarithmic_strain(chosen)).max() < 1e-13
    before = np.einsum("ikn,jk->ijn", deformation(chosen), rotation) - unit
    wanted = np.einsum("ik,kln,jl->ijn", rotation, tensor(here.stress), rotation)
    assert (np.abs(tensor(respond(own, before).stress) - wanted).max(axis=(0, 1)) / stiff).max() < ROUNDING


def test_logarithmic_strain_is_the_matrix_logarithm() -> None:
    chosen = gradients()
    found = logarithmic_strain(chosen)
    for number, own in enumerate(np.moveaxis(deformation(chosen), -1, 0)):
        wanted = np.real(logm(own.T @ own)) / 2.0
        assert found[:, number] == pytest.approx([wanted[0, 0], wanted[1, 1], 2.0 * wanted[0, 1]], abs=1e-13)


def test_inverted_gradients_are_found() -> None:
    """Mirrored, flattened and undefined ones are; the ones beside them, and one turned by half a circle, are not."""
    bad = [np.diag([-2.5, 0.0]), np.diag([-1.0, 0.3]), np.full((2, 2), np.nan)]
    good = [np.zeros((2, 2)), np.diag([-2.5, -2.5]), np.diag([-0.99, 3.0])]
    found = is_upright(np.stack([bad[0], good[0], bad[1], good[1], bad[2], good[2]], axis=-1))
    assert found.tolist() == [False, True] * 3
    assert is_upright(gradients()).all()


def test_gradients_too_flat_for_rounding_are_inverted() -> None:
    """Their determinants are positive, but not all their logarithmic strains can be had; those of all others can."""
    rng = np.random.default_rng(1)
    first, ratio = 10.0 ** rng.uniform(-0.5, 6.0, 4000), 10.0 ** rng.uniform(-12.0, -3.0, 4000)
    turned, placed = (np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]]) for t in rng.uniform(0, 7, (2, 4000)))
    stretched = turned * np.stack([first, first * ratio])
    flat = np.einsum("ijn,kjn->ikn", stretched, placed) - np.eye(2)[:, :, None]
    found = is_upright(flat)
    assert found[ratio > 1e-6].all()
    assert not found[ratio < 1e-8].any()
    with np.errstate(all="raise"):
        assert np.isfinite(logarithmic_strain(flat[..., found])).all()
        with pytest.raises(FloatingPointError):
            logarithmic_strain(flat)


def test_simple_shear_has_its_closed_forms() -> None:
    """Kirchhoff shear stress under x = X + g Y, in the invariants of each law: the energies are those that are meant.

    Neo-Hookean: mu g. With the stretch 1/2 (g + sqrt(4 + g^2)) = exp(asinh(g/2)) and the principal axes at
    tan(2 angle) = 2/g: 2 mu asinh(g/2) sin(2 angle) for Hencky, (2 mu/alpha) sinh(alpha asinh(g/2)) sin(2 angle) for
    Ogden. Green: S = lam tr(E) I + 2 mu E by hand.
    """
    gradient = np.zeros((2, 2, SHEARS.size))
    gradient[0, 1] = SHEARS
    own = {law: tissue_of(law, EXPONENT, MATERIALS[:1], np.zeros(SHEARS.size, dtype=int)) for law in Law}
    lam, mu = lame(MATERIALS[0])
    sine, log = 2.0 / np.sqrt(4.0 + SHEARS**2), np.arcsinh(SHEARS / 2.0)
    wanted = {
        Law.NEO_HOOKEAN: mu * SHEARS,
        Law.HENCKY: 2.0 * mu * log * sine,
        Law.OGDEN: 2.0 * mu / EXPONENT * np.sinh(EXPONENT * log) * sine,
        Law.GREEN: mu * SHEARS + SHEARS * (lam / 2.0 + mu) * SHEARS**2,
    }
    for law in Law:
        assert first_stress(own[law], gradient)[0, 1] == pytest.approx(wanted[law], rel=1e-13)


def test_volume_change_has_its_closed_form() -> None:
    """Equal stretches l in the plane: J = l^2; the energies' volumetric parts, by hand."""
    stretch = np.array([0.9, 1.2])
    gradient = (stretch - 1.0) * np.eye(2)[..., None]
    lam, mu = lame(MATERIALS[0])
    volume, bulk = stretch**2, lam + 2.0 * mu / 3.0
    green = (stretch**2 - 1.0) / 2.0
    wanted = {
        Law.NEO_HOOKEAN: mu / 2.0 * (volume ** (-2 / 3) * (2.0 * volume + 1.0) - 3.0) + bulk / 2.0 * (volume - 1) ** 2,
        Law.HENCKY: (2.0 * lam + 2.0 * mu) * np.log(stretch) ** 2,
        Law.GREEN: (2.0 * lam + 2.0 * mu) * green**2,
    }
    for law, energy in wanted.items():
        own = tissue_of(law, EXPONENT, MATERIALS[:1], np.zeros(stretch.size, dtype=int))
        assert stored_energy(own, gradient).real == pytest.approx(energy, rel=1e-12)


def test_ogden_of_exponent_two_is_neo_hookean() -> None:
    chosen = gradients()
    index = np.arange(chosen.shape[-1]) % len(MATERIALS)
    ogden, hooke = (respond(tissue_of(law, 2.0, MATERIALS, index), chosen) for law in (Law.OGDEN, Law.NEO_HOOKEAN))
    assert np.array_equal(ogden.stress, hooke.stress)
    assert np.array_equal(ogden.tangent, hooke.tangent)
