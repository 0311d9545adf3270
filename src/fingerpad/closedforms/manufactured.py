"""Manufactured solution on the finger's curved, layered section: errors fall with the orders of second-order elements.

A smooth displacement u that is no polynomial is made the exact solution by its own load, int sigma(u) : eps(v) dA over
all layers: the body force and the jumps of traction at interfaces and faces that u needs. On the bone u is prescribed.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from skfem import LinearForm
from skfem.helpers import ddot, eye, sym_grad, trace

from ..arrays import FloatArray
from ..scene.scene import Scene
from ..tissue.condensation import section_stiffness
from ..tissue.elasticity import displacement_basis, lame, mesh_dofs
from ..tissue.mesh import nominal_mesh
from .comparison import EXACT_ORDER, Comparison, compare_fields, on_spacings
from .equilibrium import linear_equilibrium

WAVE = 0.6  # of the exact displacement [1/mm]; source: a period is two thirds of the section's width
AMPLITUDE = 0.01  # of the exact displacement [mm]; linear, so any
SPACINGS = (0.8, 0.4, 0.2)  # mm; source: 0.8 is the section's coarsest (config/config.yaml)
CASE = "Manufactured solution"


def displacement(x: FloatArray, y: FloatArray) -> FloatArray:
    """Exact displacement (2, ...) [mm]."""
    return AMPLITUDE * np.array([np.sin(WAVE * x) * np.cos(WAVE * y / 2.0), np.exp(WAVE * x / 4.0) * np.sin(WAVE * y)])


def gradient(x: FloatArray, y: FloatArray) -> FloatArray:
    """Exact displacement gradient (2, 2, ...) [1]."""
    sin, cos, growth = np.sin(WAVE * x), np.cos(WAVE * x), np.exp(WAVE * x / 4.0)
    first = [cos * np.cos(WAVE * y / 2.0), -sin * np.sin(WAVE * y / 2.0) / 2.0]
    second = [growth * np.sin(WAVE * y) / 4.0, growth * np.cos(WAVE * y)]
    return AMPLITUDE * WAVE * np.array([first, second])


def rows(scene: Scene) -> list[Comparison]:
    """Errors on ever finer meshes of the scene's section, and the orders with which they fall."""
    return on_spacings(partial(manufactured, scene), SPACINGS)


def manufactured(scene: Scene, spacing: float) -> list[Comparison]:
    """Errors in L2 and in energy on elements of at most that size [mm]."""
    same = uniform(scene, spacing)
    section = nominal_mesh(same)
    matrix, dofs = section_stiffness(section, scene), mesh_dofs(section.mesh)
    basis = displacement_basis(section.mesh, order=EXACT_ORDER)
    finger = scene.model.finger
    layers = np.array([lame(layer.material) for layer in finger.layers])
    lam, mu = layers[section.layer].T[..., None]
    x, y = np.asarray(basis.global_coordinates())
    exact = gradient(x, y)
    exact = (exact + np.swapaxes(exact, 0, 1)) / 2.0

    @LinearForm
    def work(v, w):  # type: ignore[no-untyped-def]  # skfem's forms are untyped
        return ddot(w.lam * eye(trace(exact), 2) + 2.0 * w.mu * exact, sym_grad(v))

    field = np.zeros(basis.N)
    field[dofs] = displacement(*section.mesh.doflocs)
    points = np.ones_like(x)
    load = work.assemble(basis, lam=lam * points, mu=mu * points)
    found = basis.interpolate(linear_equilibrium(matrix, dofs[:, section.fixed].ravel(), field, load))

    def energy(tensor: FloatArray) -> FloatArray:  # its square is the energy density, twice
        parts = [np.sqrt(lam) * trace(tensor), *(np.sqrt(2.0 * mu) * tensor[i, j] for i in (0, 1) for j in (0, 1))]
        return np.stack(parts)

    mesh = spacing, int(basis.N)
    return [
        compare_fields(CASE, "displacement", mesh, np.asarray(found), displacement(x, y), basis.dx),
        compare_fields(CASE, "energy", mesh, energy(sym_grad(found)), energy(exact), basis.dx),
    ]


def uniform(scene: Scene, size: float) -> Scene:
    """The scene, meshed with elements of one size [mm]."""
    numerics = replace(
        scene.model.numerics,
        edge_size=size,
        face_size=size,
        receptor_size=size,
        nail_size=size,
        largest_size=size,
    )
    return scene.with_model(numerics=numerics)
