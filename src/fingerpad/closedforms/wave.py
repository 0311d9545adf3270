"""Half-plane under a wave of pressure without friction: the mean stress does not depend on Poisson's ratio.

With a pressure P cos kx on y = 0, y into the half-plane, sigma_xx + sigma_yy = -2 P exp(-ky) cos kx, and displacement
is (U sin kx, V cos kx) with s = ky, kappa = 3 - 4 nu and
    U = exp(-s) (c + d s),    V = exp(-s) (c + d (s + kappa)),    d = P / (2 mu k),    2 c = (1 - kappa) d
(Timoshenko and Goodier 1970, Theory of Elasticity, chapter 3). Half a period is cut out: its sides are planes of
symmetry, and its base moves as the half-plane does there.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from skfem import Basis, ElementTriP2, ElementVector, FacetBasis, LinearForm, MeshTri, MeshTri2

from ..arrays import FloatArray
from ..fields.mean_stress import element_means, recover_linear
from ..fields.recovery import gradient_at
from ..scene.finger import Material
from ..tissue.elasticity import displacement_basis, lame, node_dofs, stiffness
from .blocks import NEAR_LIMIT, TISSUE
from .comparison import ACCURACY, EXACT_ORDER, Comparison, compare_fields, on_two_meshes
from .equilibrium import linear_equilibrium

SIDE = 1.0  # of the square block, half a period [mm]
NUMBER = np.pi / SIDE  # k [1/mm]
DIVISIONS = (8, 32)  # of the side [1]; source: the finer as the bent block's
ORDERS = {"mean stress": 2.0}  # of linear fields [1]; source: what they miss is a field's curvature


def rows() -> list[Comparison]:
    """Errors at every Poisson's ratio, and the orders with which they fall."""
    cases = (partial(wave, poisson) for poisson in (TISSUE, NEAR_LIMIT))
    return [row for case in cases for row in on_two_meshes(case, DIVISIONS, ACCURACY, ORDERS)]


def wave(poisson: float, divisions: int) -> list[Comparison]:
    """Error of the mean stress in L2, in multiples of the pressure's amplitude."""
    material, side = Material(1.0, poisson), np.linspace(0.0, SIDE, divisions + 1)
    lam, mu = lame(material)
    mesh = MeshTri2.from_mesh(MeshTri.init_tensor(side, side))
    basis = displacement_basis(mesh)
    moved = computed_displacement(basis, material)
    gradient = gradient_at(mesh, moved[node_dofs(basis)], basis.X).reshape(2, 2, mesh.nelements, -1)
    means = element_means(basis, (lam + mu) * (gradient[0, 0] + gradient[1, 1]))
    fine = displacement_basis(mesh, order=EXACT_ORDER)
    place = np.asarray(fine.global_coordinates())
    found = recover_linear(basis, np.zeros(means.size), means, place)
    name, grid = f"Pressure wave, nu = {poisson:g}", (SIDE / divisions, int(basis.N))
    return [compare_fields(name, "mean stress", grid, found, mean_stress(place), fine.dx)]


def mean_stress(place: FloatArray) -> FloatArray:
    """(sigma_xx + sigma_yy) / 2 over P (...) [1] at (2, ...) [mm]."""
    return -np.exp(-NUMBER * place[1]) * np.cos(NUMBER * place[0])


def displacement(material: Material, place: FloatArray) -> FloatArray:
    """Displacement (2, ...) over P [mm/MPa] at (2, ...) [mm]."""
    _, mu = lame(material)
    kappa, second = 3.0 - 4.0 * material.poisson, 1.0 / (2.0 * mu * NUMBER)
    first, depth, along = (1.0 - kappa) / 2.0 * second, NUMBER * place[1], NUMBER * place[0]
    across = (first + second * depth) * np.sin(along)
    return np.exp(-depth) * np.array([across, (first + second * (depth + kappa)) * np.cos(along)])


def computed_displacement(basis: Basis, material: Material) -> FloatArray:
    """Displacement (n_unknowns,) over P [mm/MPa] of the block under its pressure."""
    mesh, dofs = basis.mesh, node_dofs(basis)
    x, y = mesh.doflocs
    face = mesh.facets_satisfying(lambda place: np.isclose(place[1], 0.0))

    @LinearForm
    def work(v, w):  # type: ignore[no-untyped-def]  # skfem's forms are untyped
        return np.cos(NUMBER * w.x[0]) * v[1]

    load = work.assemble(FacetBasis(mesh, ElementVector(ElementTriP2()), facets=face, intorder=EXACT_ORDER))
    held = np.union1d(dofs[:, y == SIDE], dofs[0, (x == 0.0) | (x == SIDE)])
    matrix = stiffness(basis, [material], np.zeros(mesh.nelements, dtype=int))
    start = np.zeros(basis.N)
    start[dofs] = displacement(material, mesh.doflocs)
    return linear_equilibrium(matrix, held, start, load)
