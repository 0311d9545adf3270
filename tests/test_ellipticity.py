"""Where tissue's law stops being elliptic: against the stored energy itself, and on a mesh."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.energy import first_stress
from fingerpad.errors import EllipticityError
from fingerpad.finite.deformation import Elements, elements_of
from fingerpad.finite.ellipticity import require_elliptic, smallest_stiffness
from fingerpad.finite.hyperelasticity import tissue_of
from fingerpad.finite.pressing import press
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.finger import Material
from fingerpad.scene.tissue_law import Kinematics, Law
from fingerpad.tissue.elasticity import displacement_basis, node_dofs
from fingerpad.tissue.mesh import nominal_mesh
from scenes import scene

SKIN = [Material(0.08, 0.48)]
EXPONENT = 9.0  # of Ogden's law
STEP = 1e-5  # of central differences of the stress: their error is its square, or rounding over it
DIFFERENCES = 1e-7  # relative; both of these, times a stiffness that grows with the ninth power
# Directions 7.5 degrees apart miss the softest by 3.75 at most. What Q makes of one movement goes with the cosine of
# twice the angle: at such a distance from a minimum it is larger by 4/2 of the distance's square, in amplitudes. Of all
# movements the softest is softer still
MISSED = 2.0 * np.deg2rad(3.75) ** 2


def along(law: Law, gradient: FloatArray, angles: FloatArray) -> FloatArray:
    """Acoustic tensors (n_angles, 2, 2), d(P N)/d(u) for H + u (x) N, by differences of the first stress."""
    tissue = tissue_of(law, EXPONENT, SKIN, np.zeros(1, dtype=int))
    found = []
    for angle in angles:
        direction = np.array([np.cos(angle), np.sin(angle)])
        columns = []
        for axis in np.eye(2):
            change = STEP * np.outer(axis, direction)[..., None]
            stress = first_stress(tissue, gradient + change) - first_stress(tissue, gradient - change)
            columns.append(stress[..., 0] @ direction / (2.0 * STEP))
        found.append(columns)
    return np.array(found)


@pytest.mark.parametrize("law", Law)
def test_smallest_stiffness_is_that_of_the_stored_energy(law: Law) -> None:
    """At random gradients: below all eigenvalues on a fine grid of directions but for differences, and above the least
    by no more than the movement that belongs to it becomes stiffer in the directions looked along.
    """
    angles = np.linspace(0.0, np.pi, 144, endpoint=False)
    random = np.random.default_rng(3)
    tissue = tissue_of(law, EXPONENT, SKIN, np.zeros(1, dtype=int))
    for _ in range(12):
        gradient = 0.25 * random.standard_normal((2, 2, 1))
        tensors = along(law, gradient, angles)
        eigenvalues, movements = np.linalg.eigh(tensors)
        found = float(smallest_stiffness(tissue, gradient)[0])
        scale = float(np.abs(eigenvalues).max())
        assert found >= eigenvalues.min() - DIFFERENCES * scale
        softest = movements[eigenvalues[:, 0].argmin(), :, 0]
        amplitude = np.ptp(softest @ tensors @ softest) / 2.0
        assert found <= eigenvalues.min() + MISSED * amplitude + DIFFERENCES * scale


def test_logarithmic_law_softens_in_shear() -> None:
    """Sheared by g along its layers, incompressible tissue bears 2 mu asinh(g/2) / sqrt(1 + g^2/4), which falls from
    g = 3.02 on; other directions soften a little before. The neo-Hookean law never does."""
    gradient = np.zeros((2, 2, 401))
    gradient[0, 1] = shear = np.linspace(0.0, 4.0, 401)
    nearly = [Material(0.08, 0.4999)]
    for law, begins in ((Law.HENCKY, 3.02), (Law.NEO_HOOKEAN, np.inf)):
        left = smallest_stiffness(tissue_of(law, EXPONENT, nearly, np.zeros(401, dtype=int)), gradient)
        lost = shear[left <= 0.0]
        assert (lost.min(initial=np.inf) <= begins) and (left[shear < 0.8 * begins] > 0.0).all()
        assert (lost.size > 0) == (law is Law.HENCKY)


def test_pressing_a_device_ends_where_tissue_is_no_longer_elliptic() -> None:
    """Into half of the pad with the logarithmic law. The error names device and interface."""
    base = scene("device2").coarsened(5.0).with_kinematics(Kinematics.FINITE)
    law = replace(base.model.contact, criterion=Criterion.DEPTH, depth=2.5)
    deep = base.with_model(contact=law, tissue=replace(base.model.tissue, law=Law.HENCKY))
    section = nominal_mesh(deep)
    said = r"device=device2, interface=frictionless, pre-indentation: the tissue's law is no longer elliptic"
    with pytest.raises(EllipticityError, match=said):
        press(deep, section, None, Interface.FRICTIONLESS)


@pytest.mark.parametrize("law", [Law.HENCKY, Law.NEO_HOOKEAN])
def test_tissue_that_is_not_elliptic_is_an_error(law: Law) -> None:
    """The finger sheared evenly, by little and by much: the error names the place and what to try."""
    given = scene("device2").coarsened(5.0)
    section = nominal_mesh(given)
    basis = displacement_basis(section.mesh)
    skin = tissue_of(law, EXPONENT, SKIN, np.zeros((section.mesh.t.shape[1], 1), dtype=int))
    elements: Elements = elements_of(basis, skin, np.arange(basis.N))
    displacement = np.zeros(basis.N)
    displacement[node_dofs(basis)[0]] = 1.5 * section.mesh.doflocs[1]
    require_elliptic(elements, displacement)
    displacement *= 2.2
    if law is Law.NEO_HOOKEAN:
        require_elliptic(elements, displacement)
    else:
        where = r"elements, the first at x, y = -?\d+\.\d+, \d+\.\d+ mm: .*neo_hookean"
        with pytest.raises(EllipticityError, match=where):
            require_elliptic(elements, displacement)
