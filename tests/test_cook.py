"""Cook's membrane at finite strain: an open example of another program, and Newton's method on it.

OpenGeoSys publishes this benchmark with its results (Tests/Data/LargeDeformation/CooksMembrane; after de Souza Neto et
al. 1996 and Elguedj et al. 2008): plane strain, the neo-Hookean law with kappa/2 (J - 1)^2 which is the library's, E =
240.565 MPa, nu = 0.499, clamped at the left, 6.25 N/mm2 of shear on the right. With four-node elements it locks.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementQuad1, ElementTriP2, ElementVector, FacetBasis, LinearForm, MeshQuad, MeshTri, MeshTri2

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.equilibrium import Equilibrium, equilibrium
from fingerpad.finite.hyperelasticity import tissue_of
from fingerpad.scene.finger import Material
from fingerpad.scene.tissue_law import Law
from fingerpad.tissue.elasticity import displacement_basis, lame, node_dofs
from forms import forms

RUBBER = Material(240.565, 0.499)  # MPa, 1
SHEAR = 6.25  # MPa
TIP = (48.0, 60.0)  # mm
GAUSS = 5  # degree of 3 x 3 points, as there
FOUR_NODES = {4: 2.2867221436878916, 10: 2.840692165858716, 15: 3.3745807476269606}  # rise of the tip [mm]
FINEST = 6.891409184641067  # mm, 30 elements a side with the mean dilatation of each (F-bar), which does not lock
INCREMENTS = 4


def placed(square: FloatArray) -> FloatArray:
    """Points (2, n) of the membrane [mm] by those of the unit square."""
    s, t = square
    return np.array([48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)])


def pulled(basis: Basis) -> FloatArray:
    """Nodal forces of the shear on the right [N/mm]."""
    mesh = basis.mesh
    right = mesh.facets_satisfying(lambda x: np.isclose(x[0], TIP[0]))
    facets = FacetBasis(mesh, basis.elem, facets=right)
    return np.asarray(LinearForm(lambda v, _: SHEAR * v[1]).assemble(facets))


@pytest.mark.parametrize(("divisions", "published"), FOUR_NODES.items())
def test_forms_are_the_published_example(divisions: int, published: float) -> None:
    """The forms that the library's assembly is compared with give OpenGeoSys's numbers, locking and all.

    Meshes differ in the last digits and OpenGeoSys solves its linear systems by iterations: five in 1e5 are left.
    """
    line = np.linspace(0.0, 1.0, divisions + 1)
    grid = MeshQuad.init_tensor(line, line)
    mesh = MeshQuad(placed(grid.p), grid.t)
    basis = Basis(mesh, ElementVector(ElementQuad1()), intorder=GAUSS)
    work, stiffness = forms(Law.NEO_HOOKEAN)
    lam, mu = (value * np.ones(basis.dx.shape) for value in lame(RUBBER))
    load, field = pulled(basis), np.zeros(basis.N)
    free = basis.complement_dofs(basis.get_dofs(lambda x: np.isclose(x[0], 0.0)))
    for _ in range(10):
        given = {"state": basis.interpolate(field), "lam": lam, "mu": mu}
        matrix = stiffness.assemble(basis, **given)[free][:, free].tocsc()
        step = spsolve(matrix, (load - work.assemble(basis, **given))[free])
        field[free] += step
        if np.abs(step).max() < 1e-9:
            break
    else:
        pytest.fail("Newton's method did not converge")
    tip = int(np.argmin(np.hypot(*(mesh.p - np.array(TIP)[:, None]))))
    assert field[basis.nodal_dofs[1, tip]] == pytest.approx(published, rel=5e-5)


def membrane(law: Law, material: Material, divisions: int) -> tuple[float, list[Equilibrium]]:
    """Rise of the tip [mm] with the library's elements, and all increments."""
    line = np.linspace(0.0, 1.0, divisions + 1)
    grid = MeshTri.init_tensor(line, line)
    mesh = MeshTri2.from_mesh(MeshTri(placed(grid.p), grid.t))
    basis = displacement_basis(mesh)
    assert isinstance(basis.elem, ElementVector)
    assert isinstance(basis.elem.elem, ElementTriP2)
    dofs, load = node_dofs(basis), pulled(basis)
    tissue = tissue_of(law, 3.0, [material], np.zeros((mesh.t.shape[1], 1), dtype=int))
    held = dofs[:, mesh.doflocs[0] == 0.0].ravel()
    states: list[Equilibrium] = []
    field = np.zeros(basis.N)
    for part in np.arange(1, INCREMENTS + 1) / INCREMENTS:
        states.append(equilibrium(basis, tissue, held, field, part * load))
        field = states[-1].displacement
    tip = int(np.argmin(np.hypot(*(mesh.doflocs - np.array(TIP)[:, None]))))
    return float(field[dofs[1, tip]]), states


def test_second_order_elements_do_not_lock() -> None:
    """The tip rises to where F-bar elements lead, from below, and the steps shrink: the corner's singularity is left.

    From their last mesh but one to their last F-bar elements still move by 0.3 %, these by 1.5 %: so 1 % between them.
    """
    rises = [membrane(Law.NEO_HOOKEAN, RUBBER, divisions)[0] for divisions in (8, 16, 32)]
    first, second = np.diff(rises)
    assert first > 2.0 * second > 0.0
    assert rises[-1] == pytest.approx(FINEST, rel=0.01)
    assert rises[0] > 2.0 * FOUR_NODES[10]


@pytest.mark.parametrize("law", Law)
def test_newton_converges_quadratically(law: Law) -> None:
    """r' <= r^2 mm/N once the membrane's first step is done, down to rounding: with the true tangent every step.

    A linear rate would break this by orders: at r = 1e-3 N/mm it would have to be below 1e-3, and then below 1e-6.
    """
    _, states = membrane(law, Material(RUBBER.modulus, 0.48), 8)
    for state in states:
        peak = int(np.argmax(state.residuals))
        rounding = 1e-12 * state.residuals[peak]
        falling = state.residuals[peak:]
        assert falling[-1] < rounding
        assert 4 <= len(falling) <= 7
        for before, after in pairwise(falling):
            assert after <= max(before**2, rounding)
