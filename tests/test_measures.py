"""Measures of strain against hand values, tensors in three dimensions, and each other."""

from __future__ import annotations

import numpy as np
import pytest

from fingerpad.readouts.measures import (
    Measure,
    maximum_shear,
    measured,
    strain_energy_density,
    stress,
    von_mises_stress,
)
from fingerpad.scene.finger import Material
from fingerpad.tissue.elasticity import lame

MATERIAL = Material(0.08, 0.48)
RANDOM = np.random.default_rng(5).standard_normal((200, 3))
ROUNDING = 1e-12


def tensors(components: np.ndarray) -> np.ndarray:
    """Strain tensors (m, 3, 3) of plane strains (m, 3)."""
    found = np.zeros((len(components), 3, 3))
    found[:, 0, 0], found[:, 1, 1] = components[:, 0], components[:, 1]
    found[:, 0, 1] = found[:, 1, 0] = components[:, 2] / 2.0
    return found


def stress_tensors(components: np.ndarray) -> np.ndarray:
    """Hooke's law in three dimensions."""
    lam, mu = lame(MATERIAL)
    strain = tensors(components)
    return lam * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(3) + 2.0 * mu * strain


def test_strains_have_no_unit_and_what_a_modulus_is_in_has_its() -> None:
    units = {measure: measure.unit for measure in Measure}
    assert [measure for measure, unit in units.items() if unit == "1"] == [
        Measure.MAXIMUM_PRINCIPAL,
        Measure.MAXIMUM_SHEAR,
    ]
    assert set(units.values()) == {"1", "MPa"}


def test_stress_is_hookes_law_in_three_dimensions() -> None:
    expected = stress_tensors(RANDOM)[:, [0, 1, 2, 0], [0, 1, 2, 1]]
    assert np.abs(stress(RANDOM.ravel(), MATERIAL) - expected).max() < ROUNDING


def test_maximum_shear_is_the_difference_of_eigenvalues() -> None:
    values = np.linalg.eigvalsh(tensors(RANDOM))
    assert np.abs(maximum_shear(RANDOM.ravel()) - (values[:, 2] - values[:, 0])).max() < ROUNDING


def test_strain_energy_is_half_the_product_of_the_tensors() -> None:
    expected = np.einsum("nij,nij->n", stress_tensors(RANDOM), tensors(RANDOM)) / 2.0
    assert np.abs(strain_energy_density(RANDOM.ravel(), MATERIAL) - expected).max() < ROUNDING


def test_von_mises_is_the_norm_of_the_deviator() -> None:
    full = stress_tensors(RANDOM)
    deviator = full - np.trace(full, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3.0
    expected = np.sqrt(1.5 * np.einsum("nij,nij->n", deviator, deviator))
    assert np.abs(von_mises_stress(RANDOM.ravel(), MATERIAL) - expected).max() < ROUNDING


def test_pure_shear_by_hand() -> None:
    """Shear g: principal strains +-g/2, energy mu g²/2, von Mises stress sqrt(3) mu g."""
    shear, (_, mu) = 0.03, lame(MATERIAL)
    pure = np.array([0.0, 0.0, shear])
    expected = {
        Measure.MAXIMUM_PRINCIPAL: shear / 2.0,
        Measure.MAXIMUM_SHEAR: shear,
        Measure.STRAIN_ENERGY: mu * shear**2 / 2.0,
        Measure.VON_MISES: np.sqrt(3.0) * mu * shear,
    }
    for measure in Measure:
        assert measured(measure, pure, MATERIAL) == pytest.approx([expected[measure]], rel=1e-12)


def test_stretch_without_poisson_by_hand() -> None:
    """Stretch e at Poisson's ratio 0 is uniaxial: stress E e, energy E e²/2."""
    material, stretch = Material(2.0, 0.0), 0.01
    along = np.array([stretch, 0.0, 0.0])
    expected = {
        Measure.MAXIMUM_PRINCIPAL: stretch,
        Measure.MAXIMUM_SHEAR: stretch,
        Measure.STRAIN_ENERGY: material.modulus * stretch**2 / 2.0,
        Measure.VON_MISES: material.modulus * stretch,
    }
    for measure in Measure:
        assert measured(measure, along, material) == pytest.approx([expected[measure]], rel=1e-12)


def test_only_energy_is_not_proportional_to_the_load() -> None:
    """Strain and stress double with the load, energy quadruples: with linear tissue too the measures are not the same
    up to a factor."""
    for measure in Measure:
        power = 2.0 if measure is Measure.STRAIN_ENERGY else 1.0
        once, twice = (measured(measure, k * RANDOM.ravel(), MATERIAL) for k in (1.0, 2.0))
        assert twice == pytest.approx(2.0**power * once, rel=1e-12)
