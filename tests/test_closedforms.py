"""The library against closed forms, and the closed forms against what is known of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.closedforms import bending, layers, patch, punch, spence
from fingerpad.closedforms.blocks import pressed
from fingerpad.closedforms.comparison import ORDER_OF
from fingerpad.closedforms.energy import first_stress
from fingerpad.closedforms.table import CASES
from fingerpad.contact.formulation import Status
from fingerpad.finite.hyperelasticity import tissue_of
from fingerpad.scene.finger import Layer, Material
from fingerpad.scene.tissue_law import Law
from scenes import scene

PAD = scene("device2").model.finger.pad
ROUNDING = 1e-12  # relative; some thousand units of rounding
STEP = 1e-3  # mm; central differences are off by its square times third derivatives over first ones, less than one


@pytest.mark.parametrize("name", CASES)
def test_errors_are_within_tolerance_and_fall(name: str) -> None:
    """What has a tolerance keeps it; everything is better on the finest mesh than on the coarsest."""
    rows = CASES[name](scene("device2"))
    judged = [row for row in rows if row.tolerance is not None]
    assert judged
    for row in judged:
        assert row.error <= row.tolerance, row
    for key in {(row.case, row.quantity) for row in rows if not row.quantity.startswith(ORDER_OF)}:
        errors = [row.error for row in rows if (row.case, row.quantity) == key]
        assert len(errors) == 1 or errors[-1] < errors[0], key


@pytest.mark.parametrize("poisson", [0.0, 0.3])
def test_bulk_patch_of_compressible_tissue(poisson: float) -> None:
    """A uniform strain on curved elements, where lambda is small or none."""
    (row,) = patch.bulk(poisson)
    assert row.error < patch.ROUNDING


def test_pressures_do_not_swing_near_incompressibility() -> None:
    """Linear tractions are stable: nodal pressure is as good at 0.4999 as at 0.3, to a quarter of its error."""
    common, limit = (punch.flat_punch(punch.SPACINGS[-1], poisson)[0].error for poisson in (0.3, 0.4999))
    assert limit == pytest.approx(common, rel=0.25)


def test_the_sector_is_in_equilibrium() -> None:
    """The closed form itself: free faces, and no divergence of the stress that the law's energy has; at any nu."""
    x, y = np.linspace(0.1, 0.9, 5), np.full(5, 0.7)
    for poisson in (0.0, 0.3, 0.4999):
        sector = bending.Sector(Material(1.0, poisson), bending.STRAIN)
        tissue = tissue_of(Law.HENCKY, 1.0, [sector.material], np.zeros(1, dtype=int))

        def stress(x: FloatArray, y: FloatArray, sector=sector, tissue=tissue) -> FloatArray:
            return first_stress(tissue, sector.gradient(x, y))

        faces = stress(np.array([0.0, bending.HEIGHT]), np.array([0.3, 0.3]))
        inside = np.abs(stress(x, y)).max()
        assert np.abs(faces[:, 0]).max() < 10.0 * ROUNDING * inside  # at 0.4999 lambda is 5000 mu
        across = (stress(x + STEP, y) - stress(x - STEP, y))[:, 0]
        along = (stress(x, y + STEP) - stress(x, y - STEP))[:, 1]
        assert np.abs(across + along).max() / (2.0 * STEP) < STEP**2 * inside
        moved = [sector.displacement(x + STEP, y), sector.displacement(x - STEP, y)]
        assert (moved[0] - moved[1]) / (2.0 * STEP) == pytest.approx(sector.gradient(x, y)[:, 0], abs=STEP**2)
        moved = [sector.displacement(x, y + STEP), sector.displacement(x, y - STEP)]
        assert (moved[0] - moved[1]) / (2.0 * STEP) == pytest.approx(sector.gradient(x, y)[:, 1], abs=STEP**2)


@pytest.mark.parametrize(("poisson", "friction"), spence.CASES)
def test_collocation_gives_back_the_elliptic_integrals(poisson: float, friction: float) -> None:
    """If shear lifts nothing, the eigenvalue of the integral equation is K'/K = gamma / mu: found to four digits."""
    gamma = spence.coupling(poisson)
    assert spence.coupled_ratio(gamma, friction, lift=False) == pytest.approx(
        spence.uncoupled_ratio(gamma, friction), abs=5e-5
    )


def test_the_stick_zone_does_not_know_the_load() -> None:
    """Spence's problem is self-similar: pressed ten times deeper, in one step or in five, the same nodes stick."""
    problem = punch.punched(1 / 32, 0.3, 0.2).problem
    states = [pressed(problem, depth, increments) for depth, increments in ((1e-5, 1), (1e-4, 1), (1e-4, 5))]
    sticking = [state.status == Status.STICK for state in states]
    assert 0 < np.count_nonzero(sticking[0]) < problem.position.shape[0]
    assert np.array_equal(sticking[0], sticking[1])
    assert np.array_equal(sticking[1], sticking[2])


@pytest.mark.parametrize("k", [0.2, 2.0, 50.0])
def test_layer_stiffness_is_symmetric_and_positive(k: float) -> None:
    """Betti's reciprocity, and energy for every displacement of the faces; also where exponentials would overflow."""
    for layer in PAD:
        found = layers.layer_stiffness(layer, k)
        assert np.abs(found - found.T).max() < ROUNDING * np.abs(found).max()
        assert np.linalg.eigvalsh((found + found.T) / 2.0).min() > 0.0


def test_a_thick_layer_is_a_half_plane() -> None:
    """Under a harmonic pressure p a half-plane sinks by 2 (1 - nu^2) p / (E k)."""
    material, k = Material(2.0, 0.3), 1.5
    found = np.linalg.inv(layers.layer_stiffness(Layer("deep", 40.0, material), k)[:2, :2])
    assert found[1, 1] == pytest.approx(2.0 * (1.0 - material.poisson**2) / (material.modulus * k), rel=ROUNDING)


@pytest.mark.parametrize("load", layers.Load)
def test_layers_may_be_cut(load: layers.Load) -> None:
    """A layer in two pieces is the same layer."""
    x = np.linspace(-1.0, 1.0, 5)
    whole = layers.exact(PAD, 2, load, x)
    halves = [replace(PAD[2], thickness=PAD[2].thickness / 2.0)] * 2
    cut = layers.exact([*PAD[:2], *halves, *PAD[3:]], 2, load, x)
    assert np.abs(cut.strain - whole.strain).max() < ROUNDING * np.abs(whole.strain).max()
    assert cut.displacement == pytest.approx(whole.displacement, rel=ROUNDING)
