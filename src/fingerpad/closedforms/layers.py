"""Layered strip on a rigid base under a parabolic load on its surface, by Fourier series in plane strain.

With u_x = U(y) sin(kx), u_y = V(y) cos(kx), y into the strip and s = ky, equilibrium has the solutions
    (U, V) = e^-s (1, 1)  and  e^-s (s, s + kappa),    kappa = 3 - 4 nu,
and the same two from the layer's other face, mirrored (Kausel and Roësset 1981). From them follows the
stiffness of a layer: tractions on its faces by their displacements. No exponential grows, so no layer is too thick; the
layers' stiffnesses are eliminated from the base upwards. The sides of the strip are planes of (anti-)symmetry, so the
series k = n pi / L is exact for a strip of length 2 L.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial

import numpy as np
from skfem import ElementTriP2, ElementVector, FacetBasis, LinearForm, MeshTri2

from ..arrays import FloatArray
from ..scene.finger import Layer
from ..scene.scene import Model
from ..tissue.compliance import displaced
from ..tissue.condensation import condense
from ..tissue.elasticity import displacement_basis, facet_strain, lame, node_dofs, stiffness, unit_loads
from .blocks import refined_block
from .comparison import FIELD_TOLERANCE, Comparison, compare, refined

HALF_LENGTH = 16.0  # L of the strip [mm]
HALF_LOAD = 0.5  # half-width a of the load [mm]; source: half a pin's face
PEAK = 0.01  # of the load [MPa]; linear, so any
# Largest k times receptor depth [1]; source: strain is cut off at e^-40, below rounding, the surface's displacement at
# 1.5e-6 (measured against 160), far below FIELD_TOLERANCE
CUTOFF = 40.0
WINDOW = 1.0  # |x| up to which strain is compared [mm]; source: two half-widths of the load, where the mesh is fine
SPACINGS = (1 / 8, 1 / 16, 1 / 32)  # mm; the load ends at a vertex
GROWTH = 0.3  # of element size with distance from load and receptors [1]; source: half moves errors by 4e-5 at most
COARSEST = 16.0  # element size, of the smallest [1]: the whole mesh is refined, not only its fine part
FLAT = 1e-9  # mm by which a node may miss an interface; source: rounding
LOAD_ORDER = 4  # degree of parabola times shape function: exact


class Load(StrEnum):
    """Direction of the load: into the strip, or along its face."""

    PRESSURE = "pressure"
    SHEAR = "shear"


PARTICIPLE = {Load.PRESSURE: "Pressed", Load.SHEAR: "Sheared"}


@dataclass(frozen=True)
class Surface:
    """Strain (m, 3) [1] at depth, exx, eyy and gxy, and displacement [mm] along the load in its middle."""

    strain: FloatArray
    displacement: float


def exact(layers: Sequence[Layer], above: int, load: Load, x: FloatArray) -> Surface:
    """Fourier solution at x (m,) [mm] on the upper side of layer number `above`, which has that many above it."""
    depth = sum(layer.thickness for layer in layers[:above])
    count = int(np.ceil(CUTOFF / depth * HALF_LENGTH / np.pi))
    lam, mu = lame(layers[above].material)
    mean = PEAK * 4.0 / 3.0 * HALF_LOAD / (2.0 * HALF_LENGTH)
    strain = np.zeros((x.size, 3))
    if load is Load.PRESSURE:
        strain[:, 1] = -mean / (lam + 2.0 * mu)
    else:
        strain[:, 2] = -mean / mu
    yields = [lame(layer.material) for layer in layers]
    displacement = sum(
        mean * layer.thickness / (one + 2.0 * two if load is Load.PRESSURE else two)
        for layer, (one, two) in zip(layers, yields, strict=True)
    )
    for k in np.arange(1, count + 1) * np.pi / HALF_LENGTH:
        traction = coefficient(k) * np.array([load is Load.SHEAR, load is Load.PRESSURE], dtype=float)
        surface, (shear, normal, across) = _harmonic(layers, above, k, traction)
        # a shear that is even in x is the same harmonic a quarter of a wave on: sin -> cos, cos -> -sin
        cos, sin = np.cos(k * x), np.sin(k * x)
        even, odd = (cos, sin) if load is Load.PRESSURE else (-sin, cos)
        displacement += float(surface[1] if load is Load.PRESSURE else surface[0])
        strain += np.stack([across * even, (normal - lam * across) / (lam + 2.0 * mu) * even, shear / mu * odd], axis=1)
    return Surface(strain, displacement)


def coefficient(k: float) -> float:
    """Fourier coefficient [MPa] of the load PEAK (1 - x^2/a^2) at |x| < a: (1/L) int load cos(kx) dx."""
    s = k * HALF_LOAD
    return float(PEAK * 4.0 * HALF_LOAD / HALF_LENGTH * (np.sin(s) - s * np.cos(s)) / s**3)


def _harmonic(layers: Sequence[Layer], above: int, k: float, traction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Amplitudes (2,) [mm] at the surface, and (3,) of sigma_xy, sigma_yy [MPa] and exx [1] below `above` layers."""
    stiffnesses = [layer_stiffness(layer, k) for layer in layers]
    top = [stiffnesses[-1][:2, :2]]  # of everything from a layer's face downwards; the base does not move
    for matrix in stiffnesses[-2::-1]:
        top.insert(0, matrix[:2, :2] - matrix[:2, 2:] @ np.linalg.solve(matrix[2:, 2:] + top[0], matrix[2:, :2]))
    surface = np.asarray(np.linalg.solve(top[0], traction))
    moved = surface
    for number in range(above):
        matrix = stiffnesses[number]
        moved = -np.linalg.solve(matrix[2:, 2:] + top[number + 1], matrix[2:, :2] @ moved)
    stress = -top[above] @ moved  # on the face of what lies below, whose normal points to -y
    return surface, np.array([*stress, k * moved[0]])


def layer_stiffness(layer: Layer, k: float) -> FloatArray:
    """Stiffness (4, 4) [N/mm^3] of a layer at wave number k [1/mm]: tractions on both faces, upper first, by U, V."""
    _, mu = lame(layer.material)
    kappa = 3.0 - 4.0 * layer.material.poisson
    mirror = np.diag([1.0, -1.0])

    def moved(s: float) -> FloatArray:
        return np.exp(-s) * np.array([[1.0, s], [1.0, s + kappa]])

    def stress(s: float) -> FloatArray:  # sigma_xy, sigma_yy
        shape = np.array([[-2.0, 1.0 - kappa - 2.0 * s], [-2.0, -1.0 - kappa - 2.0 * s]])
        return mu * k * np.exp(-s) * shape

    thick = k * layer.thickness
    displacement = np.block([[moved(0.0), mirror @ moved(thick)], [moved(thick), mirror @ moved(0.0)]])
    traction = np.block([[-stress(0.0), mirror @ stress(thick)], [stress(thick), -mirror @ stress(0.0)]])
    return np.linalg.solve(displacement.T, traction.T).T


def rows(model: Model) -> list[Comparison]:
    """Strain and displacement in the pad's layers under both loads."""
    return [
        row
        for load in Load
        for row in refined(partial(layered, "layers", model.finger.pad, model.layers_above, load), SPACINGS)
    ]


def layered(name: str, layers: Sequence[Layer], above: int, load: Load, spacing: float) -> list[Comparison]:
    """Strain at the receptors, read in the layer below them, and displacement in the load's middle."""
    mesh = _strip_mesh(layers, above, spacing)
    lines = np.cumsum([layer.thickness for layer in layers])
    number = np.searchsorted(lines, mesh.p[1, mesh.t].mean(axis=0))
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    matrix = stiffness(basis, [layer.material for layer in layers], number)
    x, y = mesh.doflocs
    sides = dofs[0 if load is Load.PRESSURE else 1, np.abs(x) == HALF_LENGTH]
    fixed = np.union1d(dofs[:, y == y.max()], sides)
    face = np.flatnonzero((y == 0.0) & (np.abs(x) <= HALF_LOAD))
    force = _nodal_load(mesh, load)[dofs[:, face].T.ravel()]

    ends = mesh.p[:, mesh.facets]
    on_line = np.all(np.abs(ends[1] - lines[above - 1]) < FLAT, axis=0)
    interface = np.flatnonzero(on_line & np.all(np.abs(ends[0]) <= WINDOW, axis=0))
    adjacent = mesh.f2t[:, interface]
    points, read = facet_strain(mesh, interface, np.where(number[adjacent[0]] == above, adjacent[0], adjacent[1]))
    condensed = condense(matrix, dofs, fixed, unit_loads(dofs, face, matrix.shape[0]), read)
    found = (condensed.strain @ force).reshape(-1, 3)
    wanted = exact(layers, above, load, points[0])
    middle = int(np.argmin(np.abs(x[face])))
    moved = displaced(condensed.compliance, force)[middle, 1 if load is Load.PRESSURE else 0]
    case, grid = f"{PARTICIPLE[load]} {name}", (spacing, int(basis.N))
    return [
        *(
            compare(case, component, grid, found[:, i], wanted.strain[:, i], FIELD_TOLERANCE)
            for i, component in enumerate(("exx", "eyy", "gxy"))
        ),
        compare(case, "displacement", grid, float(moved), wanted.displacement, FIELD_TOLERANCE),
    ]


def _strip_mesh(layers: Sequence[Layer], above: int, spacing: float) -> MeshTri2:
    """Mesh of the strip: fine under the load and down to the receptors, conforming to every interface."""
    depth = sum(layer.thickness for layer in layers[:above])
    lines = np.concatenate([[0.0], np.cumsum([layer.thickness for layer in layers])])

    def size(x: FloatArray, y: FloatArray) -> FloatArray:
        away = np.hypot(np.maximum(x - 2.0 * HALF_LOAD, 0.0), np.maximum(y - depth, 0.0))
        return np.minimum(spacing + GROWTH * away, COARSEST * spacing)

    return refined_block(np.arange(0.0, HALF_LENGTH + HALF_LOAD, HALF_LOAD), lines, size)


def _nodal_load(mesh: MeshTri2, load: Load) -> FloatArray:
    """Consistent nodal forces (n_unknowns,) [N/mm] of the parabolic load."""

    @LinearForm
    def work(v, w):  # type: ignore[no-untyped-def]  # skfem's forms are untyped
        return PEAK * (1.0 - (w.x[0] / HALF_LOAD) ** 2) * v[1 if load is Load.PRESSURE else 0]

    loaded = np.flatnonzero(
        np.all(mesh.p[1, mesh.facets] == 0.0, axis=0) & (np.abs(mesh.p[0, mesh.facets].mean(axis=0)) < HALF_LOAD)
    )
    return work.assemble(FacetBasis(mesh, ElementVector(ElementTriP2()), facets=loaded, intorder=LOAD_ORDER))
