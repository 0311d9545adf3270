"""Patches: the stiffness of the nodes in contact, and of some that soon may be.

Equations of contact are written with K = C^-1 of a patch (`active_set`): the compliance of its nodes, all others
unloaded, with what deformable faces add to it. It serves until contact leaves the patch (docs/decisions/0013).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .faces import nodal_compliance
from .formulation import ContactProblem

LOST = 1e-4  # of unit displacements [1] that a stiffness may miss; source: what two refinements take to rounding
ELIMINATED = 30  # rows [1] of half a matrix below which it is not halved; source: fewest seconds of 16 to 50 (measured)


@dataclass(frozen=True)
class Patch:
    """Contact nodes (b,) by ascending index, and the forces (2b, 2b) [N/mm per mm] that unit displacements of skin and
    faces between them take: one displacement a row, ordered x0, x1, ..., y0, y1, ... stiffness_norm: the largest force
    that displacements of one in any directions take. given: (n,) index of the actuator whose face each node touches,
    and place: (n,) where [mm], if deformable, with the actuators at `actuator` (n_actuators, 2) [mm].
    """

    nodes: np.ndarray
    response: FloatArray
    stiffness_norm: float
    given: np.ndarray
    place: FloatArray
    actuator: FloatArray


def patch_of(
    problem: ContactProblem, nodes: np.ndarray, place: FloatArray, there: FloatArray | None, actuator: FloatArray
) -> Patch:
    """Stiffness of some nodes, all other nodes unloaded. there: where skin at these places (n,) [mm] touches deformable
    faces (`faces.touch`). Raises LinAlgError if their compliance is singular.
    """
    compliance = nodal_compliance(problem, nodes, there)
    held = np.flatnonzero(np.diag(compliance) == 0.0)
    compliance[held, held] = 1.0  # what does not move answers no load: any stiffness leaves it where it is
    response = _inverse(compliance)
    if not _answers(response, compliance):
        response = np.asarray(np.linalg.inv(compliance).T, dtype=float)
    stiffness_norm = float(np.abs(response).sum(axis=0).max())
    return Patch(nodes, response, stiffness_norm, problem.actuator_of, place, actuator)


def nodes_of(problem: ContactProblem, needed: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """Nodes (b,) that a patch takes, of those `needed` (k,) and those that may be `ahead` (n,)."""
    return np.union1d(needed, np.flatnonzero(ahead)) if problem.patches else np.arange(ahead.size)


def holds(patch: Patch, nodes: np.ndarray) -> bool:
    """Whether some nodes (k,), by ascending index, lie within a patch."""
    place = np.searchsorted(patch.nodes, nodes)
    return nodes.size == 0 or bool(nodes[-1] <= patch.nodes[-1] and (patch.nodes[place] == nodes).all())


def _answers(response: FloatArray, compliance: FloatArray) -> bool:
    """Whether the forces of an even and of an alternating displacement cause them again, but for LOST."""
    moved = np.ones((2, compliance.shape[0]))
    moved[1, ::2] = -1.0
    return bool(np.abs(moved @ response @ compliance.T - moved).max() < LOST)


def _inverse(matrix: FloatArray) -> FloatArray:
    """Inverse of a symmetric matrix (n, n) whose leading blocks are regular, by halves of halves: products of matrices
    take a quarter of the seconds that elimination does. Without pivots digits are lost where halves are much alike, all
    of them where the matrix is not symmetric.
    """
    half = matrix.shape[0] // 2
    if half < ELIMINATED:
        return np.asarray(np.linalg.inv(matrix), dtype=float)
    right = matrix[:half, half:]
    first = _inverse(matrix[:half, :half])
    carried = first @ right
    inverse = np.empty_like(matrix)
    inverse[half:, half:] = _inverse(matrix[half:, half:] - right.T @ carried)
    inverse[:half, half:] = -carried @ inverse[half:, half:]
    inverse[half:, :half] = inverse[:half, half:].T
    inverse[:half, :half] = first - inverse[:half, half:] @ carried.T
    return inverse
