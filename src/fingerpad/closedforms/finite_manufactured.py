"""Manufactured solution of large strain on the finger's curved, layered section, under the scene's law.

The section is stretched, waved as in `manufactured` and turned,
    x = R ((1 + s) X + w(X)),
which is its deformation under int P(u) : grad v dA over all layers, with the stress P from the law's energy alone
(`energy`). On the bone it is prescribed. The stretch keeps every layer in tension: stiff skin and nail on soft tissue
wrinkle under a few per cent of compression, and next to that no solution is well determined.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from skfem import LinearForm
from skfem.helpers import ddot, grad

from ..arrays import FloatArray
from ..finite.hyperelasticity import tissue_of
from ..scene.scene import Scene
from ..tissue.elasticity import displacement_basis, node_dofs
from ..tissue.mesh import nominal_mesh
from .comparison import EXACT_ORDER, Comparison, compare_fields, on_spacings
from .energy import first_stress
from .equilibrium import equilibrium
from .manufactured import SPACINGS, displacement, gradient, uniform

EXPANSION = 0.15  # s [1]; source: above the compression that w brings about
WAVES = 5.0  # w over the displacement of `manufactured` [1]: its gradients reach 0.1
TURN = 0.5  # angle of R [rad]; source: beyond what small strain could take for one
ROTATION = np.array([[np.cos(TURN), -np.sin(TURN)], [np.sin(TURN), np.cos(TURN)]])
CASE = "Finite manufactured"


def rows(scene: Scene) -> list[Comparison]:
    """Errors on ever finer meshes of the scene's section, and the orders with which they fall."""
    return on_spacings(partial(manufactured, scene), SPACINGS)


def large_displacement(place: FloatArray) -> FloatArray:
    """Exact displacement (2, ...) [mm] at (2, ...) [mm]."""
    stretched = (1.0 + EXPANSION) * place + WAVES * displacement(*place)
    return np.tensordot(ROTATION, stretched, 1) - place


def large_gradient(place: FloatArray) -> FloatArray:
    """Exact displacement gradient (2, 2, ...) [1] at (2, ...) [mm]."""
    unit = np.eye(2).reshape(2, 2, *(1 for _ in place.shape[1:]))
    stretched = (1.0 + EXPANSION) * unit + WAVES * gradient(*place)
    return np.tensordot(ROTATION, stretched, 1) - unit


def manufactured(scene: Scene, spacing: float) -> list[Comparison]:
    """Errors of displacement and gradient in L2 on elements of at most that size [mm]."""
    same = uniform(scene, spacing)
    section = nominal_mesh(same)
    materials, law = scene.model.finger.materials, scene.model.tissue
    tissue = tissue_of(law.law, law.ogden_exponent, materials, section.layer[:, None])
    basis = displacement_basis(section.mesh)
    dofs = node_dofs(basis)
    fine = displacement_basis(section.mesh, order=EXACT_ORDER)
    place = np.asarray(fine.global_coordinates())
    stress = first_stress(tissue, large_gradient(place))

    @LinearForm
    def work(v, w):  # type: ignore[no-untyped-def]  # skfem's forms are untyped
        return ddot(stress, grad(v))

    start = np.zeros(basis.N)
    start[dofs] = large_displacement(section.mesh.doflocs)
    held = dofs[:, section.fixed].ravel()
    found = fine.interpolate(equilibrium(basis, tissue, held, start, work.assemble(fine)).displacement)
    mesh = spacing, int(basis.N)
    return [
        compare_fields(CASE, "displacement", mesh, np.asarray(found), large_displacement(place), fine.dx),
        compare_fields(CASE, "gradient", mesh, np.asarray(grad(found)), large_gradient(place), fine.dx),
    ]
