"""Finite patch tests: a stretched and a sheared block of curved elements deform uniformly under every law.

The block is stretched to a prescribed length with its sides free, so it finds its width; or its boundary is sheared, so
its inside finds the same shear. The mean nominal stress of a body follows from the forces on its boundary,
    P_ij = (1/A) sum over nodes of f_i X_j,
and is compared with the derivative of the law's energy (`energy`).
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from skfem import MeshTri, MeshTri2

from ..arrays import FloatArray
from ..finite.hyperelasticity import Tissue, tissue_of
from ..scene.tissue_law import Law
from ..tissue.elasticity import displacement_basis, node_dofs
from .comparison import Comparison, compare
from .energy import first_stress
from .equilibrium import equilibrium
from .patch import ROUNDING, SOFT

STRETCH = 1.3  # length over undeformed length [1]; source: any that is far from linear
SHEAR = 0.5  # tangent of the angle [1]; source: as for the stretch
EXPONENT = 9.0  # of Ogden's law [1]; source: config/config.yaml
DIVISIONS = 4  # of the block, each way [1]
BULGE = 0.05  # displacement of the block's inner nodes [mm]: curves all elements
ASTRAY = 0.003  # displacement of nodes from the exact solution where Newton's method begins [mm]


def rows() -> list[Comparison]:
    """Stretch and shear under every law."""
    return [case(law) for case in (stretched, sheared) for law in Law]


def stretched(law: Law) -> Comparison:
    """A block stretched to STRETCH of its height, its left side on rollers and its right one free."""
    tissue = _tissue(law)

    def across(wide: float) -> float:
        return float(first_stress(tissue, _gradient(wide - 1.0, 0.0, STRETCH - 1.0))[0, 0, 0, 0])

    wide = float(brentq(across, 1.0 / STRETCH**2, 1.0, xtol=1e-15, rtol=1e-14))
    return _compared("Finite stretch", tissue, _gradient(wide - 1.0, 0.0, STRETCH - 1.0), free_side=True)


def sheared(law: Law) -> Comparison:
    """A block whose boundary moves by x = X + SHEAR Y."""
    return _compared("Finite shear", _tissue(law), _gradient(0.0, SHEAR, 0.0), free_side=False)


def block(divisions: int) -> MeshTri2:
    """Unit square [mm] of second-order triangles that are curved inside."""
    line = np.linspace(0.0, 1.0, divisions + 1)
    grid = MeshTri2.from_mesh(MeshTri.init_tensor(line, line))
    x, y = grid.doflocs
    bulge = BULGE * np.sin(np.pi * x) * np.sin(np.pi * y)
    return MeshTri2(np.array([x + bulge, y - bulge]), grid.t)


def _tissue(law: Law) -> Tissue:
    return tissue_of(law, EXPONENT, [SOFT], np.zeros((1, 1), dtype=int))


def _gradient(xx: float, xy: float, yy: float) -> FloatArray:
    """Uniform displacement gradient (2, 2, 1, 1)."""
    return np.array([[xx, xy], [0.0, yy]])[..., None, None]


def _compared(case: str, tissue: Tissue, gradient: FloatArray, free_side: bool) -> Comparison:
    """Mean nominal stress of the block under a uniform gradient (2, 2, 1, 1), beside the law's."""
    mesh = block(DIVISIONS)
    basis = displacement_basis(mesh)
    dofs = node_dofs(basis)
    x, y = mesh.doflocs
    if free_side:
        held = np.concatenate([dofs[0, x == 0.0], dofs[1, (y == 0.0) | (y == 1.0)]])
    else:
        held = dofs[:, (x == 0.0) | (x == 1.0) | (y == 0.0) | (y == 1.0)].ravel()
    exact = np.zeros(basis.N)
    exact[dofs] = gradient[..., 0, 0] @ mesh.doflocs
    start = exact.copy()
    start[dofs] += ASTRAY * np.array([np.sin(3.0 * x + y), np.cos(x - 2.0 * y)])
    start[held] = exact[held]
    found = equilibrium(basis, tissue, held, start, np.zeros(basis.N))
    stress = found.force[dofs] @ mesh.doflocs.T  # over the area, 1 mm2
    wanted = first_stress(tissue, gradient)
    return compare(case, str(tissue.law), (1.0 / DIVISIONS, int(basis.N)), stress.ravel(), wanted.ravel(), ROUNDING)
