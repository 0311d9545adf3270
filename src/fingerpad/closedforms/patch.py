"""Patch tests: a uniform strain, and a uniform contact pressure, come out to rounding."""

from __future__ import annotations

import numpy as np
from skfem import MeshTri, MeshTri2

from ..scene.device import ActuatorRow
from ..scene.finger import Material
from ..tissue.elasticity import displacement_basis, facet_strain, lame, node_dofs, stiffness
from .blocks import NEAR_LIMIT, TISSUE, block_contact, block_mesh, pressed
from .comparison import Comparison, compare
from .equilibrium import linear_equilibrium

ROUNDING = 1e-10  # relative [1]; source: rounding, 1e-16, times the condition of the stiffness, 1e6 at nu = 0.4999
GRADIENT = np.array([[0.01, -0.003], [0.02, 0.005]])  # of the uniform displacement [1]: stretch, shear and rotation
DIVISIONS = 5  # of the bulk patch, each way [1]
SOFT = Material(0.08, TISSUE)  # the dermis (config/config.yaml)


def rows() -> list[Comparison]:
    """Both patch tests, the first for the tissue and near incompressibility."""
    return [*bulk(SOFT.poisson), *bulk(NEAR_LIMIT), *contact()]


def bulk(poisson: float) -> list[Comparison]:
    """A linear displacement on the boundary of curved elements gives the same uniform strain everywhere."""
    mesh = _annulus(DIVISIONS)
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    matrix = stiffness(basis, [Material(1.0, poisson)], np.zeros(mesh.t.shape[1], dtype=int))
    field = np.zeros(basis.N)
    field[dofs] = GRADIENT @ mesh.doflocs
    field = linear_equilibrium(matrix, basis.get_dofs().all(), field, np.zeros(basis.N))
    _, strain = facet_strain(mesh, np.arange(mesh.facets.shape[1]), mesh.f2t[0])
    wanted = np.array([GRADIENT[0, 0], GRADIENT[1, 1], GRADIENT[0, 1] + GRADIENT[1, 0]])
    found = strain @ field
    mesh_size = 1.0 / DIVISIONS, int(basis.N)
    exact = np.tile(wanted, found.size // wanted.size)
    return [compare("Patch tests", f"strain, nu = {poisson:g}", mesh_size, found, exact, ROUNDING)]


def contact() -> list[Comparison]:
    """A flat face on a confined block of height H: pressure (lambda + 2 mu) d / H at every node."""
    height, depth, divisions = 1.0, 0.01, 4  # mm, mm, 1
    mesh = block_mesh(np.linspace(0.0, 1.0, divisions + 1), np.linspace(0.0, height, divisions + 1))
    block = block_contact(mesh, SOFT, ActuatorRow((0.0,), 6.0, 0.0), friction=0.0, reach=1.0, confined=True)
    pressure = pressed(block.problem, depth, 1).force[:, 1] / block.weight
    lam, mu = lame(SOFT)
    exact = np.full(pressure.size, (lam + 2.0 * mu) * depth / height)
    return [compare("Patch tests", "contact pressure", (1.0 / divisions, block.unknowns), pressure, exact, ROUNDING)]


def _annulus(divisions: int) -> MeshTri2:
    """Quarter annulus (radii 1 and 2 mm) of curved second-order triangles."""
    grid = MeshTri2.from_mesh(
        MeshTri.init_tensor(np.linspace(1.0, 2.0, divisions + 1), np.linspace(0.0, np.pi / 2, divisions + 1))
    )
    radius, angle = grid.doflocs
    return MeshTri2(np.array([radius * np.cos(angle), radius * np.sin(angle)]), grid.t)
