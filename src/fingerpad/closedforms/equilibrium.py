"""Equilibrium without contact: of linear tissue, and of tissue that deforms much, by Newton's method."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from skfem import Basis, condense, solve
from skfem.utils import solver_direct_scipy

from ..arrays import FloatArray
from ..errors import ConvergenceError
from ..finite.deformation import elements_of, internal_force, tangent_stiffness
from ..finite.hyperelasticity import Tissue
from ..tissue.elasticity import node_dofs
from ..tissue.factors import factorise, fill_reducing_order

STEP = 1e-9  # last change of displacement over the largest of it [1]; source: its square is below rounding
MAX_STEPS = 20  # of Newton's method [1]; source: 4-7 are usual


@dataclass(frozen=True)
class Equilibrium:
    """displacement: (size,) [mm]. force: (size,) that holds it [N/mm]. residuals: largest force out of balance before
    every Newton step, and at the end [N/mm].
    """

    displacement: FloatArray
    force: FloatArray
    residuals: tuple[float, ...]


def linear_equilibrium(matrix: csc_matrix, held: np.ndarray, start: FloatArray, load: FloatArray) -> FloatArray:
    """Displacement (size,) [mm] of a stiffness under a load (size,) [N/mm]; unknowns `held` (k,) stay as they start."""
    solver = solver_direct_scipy(permc_spec="MMD_AT_PLUS_A")
    return solve(*condense(matrix, load, x=start, D=held), solver=solver)


def equilibrium(basis: Basis, tissue: Tissue, held: np.ndarray, start: FloatArray, load: FloatArray) -> Equilibrium:
    """Equilibrium of tissue that deforms much under a dead load (size,) [N/mm], found from a displacement `start`
    (size,) [mm] with a new tangent every step.

    held: unknowns (k,) that stay as they start. Raises ConvergenceError, CondensationError, InvertedError.
    """
    everywhere = tangent_stiffness(elements_of(basis, tissue, np.arange(basis.N)), start)
    elements = elements_of(basis, tissue, fill_reducing_order(everywhere, node_dofs(basis), held))
    displacement, residuals, change = start.copy(), [], np.inf
    for _ in range(MAX_STEPS):
        force = internal_force(elements, displacement)
        residual = (load - force)[elements.free]
        residuals.append(float(np.abs(residual).max()))
        if change <= STEP * np.abs(displacement).max():
            return Equilibrium(displacement, force, tuple(residuals))
        step = factorise(tangent_stiffness(elements, displacement)).solve(residual)
        displacement[elements.free] += step
        change = float(np.abs(step).max())
    raise ConvergenceError(f"Newton's method left {residuals[-1]:.1e} N/mm after {MAX_STEPS} steps")
