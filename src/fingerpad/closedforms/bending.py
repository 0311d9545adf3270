"""A block of Hencky tissue bent into a circular sector: finite, inhomogeneous strain with a closed form at every nu.

The line X = const becomes a circle of radius r(X), the line Y = const its ray at the angle c Y, so the stretches are
lambda_1 = r' and lambda_2 = c r. The energy W(lambda_1, lambda_2) does not depend on X, so W - lambda_1 dW/dlambda_1 is
the same everywhere (Ogden 1984, Non-linear Elastic Deformations, chapter 5; Bruhns, Xiao and Meyers 2002 for this law).
The faces are free, so with e = ln lambda and e_2 = -a on the inner face, e_2 = a on the outer one,
    (lam/2)(e_1 + e_2)^2 + mu (e_1^2 + e_2^2) - lam (e_1 + e_2) - 2 mu e_1 = 2 mu (lam + mu)/(lam + 2 mu) a^2,
a quadratic equation for e_1(e_2), and c X = int exp(s - e_1(s)) ds from -a to e_2.

Displacement and its gradient, which receptors feel, are held to the elements' orders at every Poisson's ratio, and the
mean stress as `mean_stress` recovers it to a tolerance: at the quadrature points themselves it oscillates.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.polynomial import Chebyshev
from skfem import Basis, MeshTri, MeshTri2
from skfem.helpers import grad

from ..arrays import FloatArray
from ..fields.mean_stress import element_means, recover_linear
from ..finite.deformation import displacement_gradient, elements_of
from ..finite.hyperelasticity import tissue_of
from ..scene.finger import Material
from ..scene.tissue_law import Law
from ..tissue.elasticity import displacement_basis, lame, node_dofs
from .blocks import NEAR_LIMIT, TISSUE
from .comparison import EXACT_ORDER, FIELD_TOLERANCE, ORDERS, Comparison, compare_fields, on_two_meshes
from .equilibrium import equilibrium

HEIGHT = 1.0  # H of the block [mm]
LENGTH = 2.0  # of the block [mm]
STRAIN = 0.2  # a, logarithmic, of the faces [1]; source: any that is far from linear
RATIOS = (TISSUE, 0.499, NEAR_LIMIT)  # Poisson's [1]
DIVISIONS = (16, 32)  # of the height [1]; source: on coarser ones Newton's method fails at 0.4999
ITERATIONS = 8  # of Newton's method for the strain at a place [1]; source: rounding is left after 4 (measured)
DEGREE = 40  # of the polynomial that inverts c X [1]; source: rounding


@dataclass(frozen=True)
class Sector:
    """The exact bent block. material: of Hencky's law. strain: a, logarithmic, of the faces [1]."""

    material: Material
    strain: float

    def radial(self, hoop: FloatArray) -> FloatArray:
        """e_1 [1] where e_2 is `hoop`."""
        lam, mu = lame(self.material)
        square = lam / 2.0 + mu
        linear = lam * hoop - lam - 2.0 * mu
        energy = 2.0 * mu * (lam + mu) / (lam + 2.0 * mu) * self.strain**2
        rest = square * hoop**2 - lam * hoop - energy
        return 2.0 * rest / (np.sqrt(linear**2 - 4.0 * square * rest) - linear)

    @cached_property
    def _way(self) -> Chebyshev:
        """c X [1] as a polynomial of e_2."""
        slope = Chebyshev.interpolate(lambda s: np.exp(s - self.radial(s)), DEGREE, [-self.strain, self.strain])
        return slope.integ(lbnd=-self.strain)

    @property
    def curvature(self) -> float:
        """c [1/mm]: angle of the sector over the block's length."""
        return float(self._way(self.strain)) / HEIGHT

    def hoop(self, x: FloatArray) -> FloatArray:
        """e_2 [1] at X = x [mm], by Newton's method."""
        found = self.strain * (2.0 * x / HEIGHT - 1.0)
        for _ in range(ITERATIONS):
            found = found - (self._way(found) - self.curvature * x) / np.exp(found - self.radial(found))
        return found

    def displacement(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Displacement (2, ...) [mm]; the middle of the end Y = 0 stays."""
        radius = np.exp(self.hoop(x)) / self.curvature
        middle = float(np.exp(self.hoop(np.array(HEIGHT / 2.0))) / self.curvature)
        angle = self.curvature * y
        return np.array([radius * np.cos(angle) - middle + HEIGHT / 2.0 - x, radius * np.sin(angle) - y])

    def gradient(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Displacement gradient (2, 2, ...) [1]."""
        hoop, angle = self.hoop(x), self.curvature * y
        across, along = np.exp(self.radial(hoop)), np.exp(hoop)
        cos, sin = np.cos(angle), np.sin(angle)
        return np.array([[across * cos - 1.0, -along * sin], [across * sin, along * cos - 1.0]])

    def mean_stress(self, x: FloatArray) -> FloatArray:
        """Mean Kirchhoff stress in the plane, (lam + mu)(e_1 + e_2) [MPa]."""
        lam, mu = lame(self.material)
        hoop = self.hoop(x)
        return (lam + mu) * (self.radial(hoop) + hoop)


@dataclass(frozen=True)
class Bent:
    """The bent block as the elements compute it. displacement: (size,) of all unknowns of the basis [mm]. mean_stress:
    (n_elements, n_points) mean Kirchhoff stress in the plane at the basis's quadrature points [MPa].
    """

    material: Material
    basis: Basis
    displacement: FloatArray
    mean_stress: FloatArray

    def recovered(self, place: FloatArray) -> FloatArray:
        """Mean stress (n_elements, k) [MPa] as it is read, at places (2, n_elements, k) [mm] of each element."""
        means = element_means(self.basis, self.mean_stress)
        return recover_linear(self.basis, np.zeros(means.size), means, place)


def rows() -> list[Comparison]:
    """Errors at every Poisson's ratio, and the orders with which they fall."""
    cases = (partial(bent, poisson) for poisson in RATIOS)
    return [row for case in cases for row in on_two_meshes(case, DIVISIONS, FIELD_TOLERANCE, ORDERS)]


def bent(poisson: float, divisions: int) -> list[Comparison]:
    """Errors of displacement, its gradient and the mean stress in L2."""
    found = bend(poisson, divisions)
    exact = Sector(found.material, STRAIN)
    fine = displacement_basis(found.basis.mesh, order=EXACT_ORDER)
    place, field = np.asarray(fine.global_coordinates()), fine.interpolate(found.displacement)
    name, grid = f"Bent block, nu = {poisson:g}", (HEIGHT / divisions, int(fine.N))
    return [
        compare_fields(name, "displacement", grid, np.asarray(field), exact.displacement(*place), fine.dx),
        compare_fields(name, "gradient", grid, np.asarray(grad(field)), exact.gradient(*place), fine.dx),
        compare_fields(name, "mean stress", grid, found.recovered(place), exact.mean_stress(place[0]), fine.dx),
    ]


def bend(poisson: float, divisions: int) -> Bent:
    """The block in equilibrium between its two ends, which are held where the closed form has them."""
    material = Material(1.0, poisson)
    mesh = block(divisions)
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    x, y = mesh.doflocs
    start = np.zeros(basis.N)
    start[dofs] = Sector(material, STRAIN).displacement(x, y)
    held = dofs[:, (y == 0.0) | (y == LENGTH)].ravel()
    tissue = tissue_of(Law.HENCKY, 1.0, [material], np.zeros((mesh.t.shape[1], 1), dtype=int))
    found = equilibrium(basis, tissue, held, start, np.zeros(basis.N)).displacement
    (a, b), (c, d) = displacement_gradient(elements_of(basis, tissue, dofs.ravel()), found)
    lam, mu = lame(material)
    stress = (lam + mu) * np.log((1.0 + a) * (1.0 + d) - b * c)
    return Bent(material, basis, found, stress)


def block(divisions: int) -> MeshTri2:
    """Second-order triangles on the undeformed block."""
    return MeshTri2.from_mesh(
        MeshTri.init_tensor(
            np.linspace(0.0, HEIGHT, divisions + 1),
            np.linspace(0.0, LENGTH, round(divisions * LENGTH / HEIGHT) + 1),
        )
    )
