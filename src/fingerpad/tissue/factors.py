"""Factors of a sparse symmetric stiffness: a fill-reducing order, LU factors in it, and what they leave of K u = f."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix, diags_array
from scipy.sparse.linalg import SuperLU, splu

from ..arrays import FloatArray
from ..errors import CondensationError

PIVOT_LIMIT = 1e-14  # of the largest pivot [1]; source: rounding; held tissue of contrast 1e6 stays above 1e-10

SINGULAR = "the stiffness is singular: nothing holds some of the tissue"


def fill_reducing_order(
    matrix: csc_matrix, dofs: np.ndarray, held: np.ndarray, last: np.ndarray | None = None
) -> np.ndarray:
    """Fill-reducing order of the unknowns that are not held, found on the graph of nodes (an eighth of the work).

    dofs: (2, n_nodes) unknowns of the nodes. held: unknowns that do not move. last: unknowns that come last. The
    factors join them to one another, and so does the graph beforehand.
    """
    free = np.ones(matrix.shape[0], dtype=bool)
    free[held] = False
    nodes = np.flatnonzero(free[dofs].any(axis=0))
    first = dofs[0, nodes]
    graph = csc_matrix(matrix[first][:, first])
    if last is not None:
        joined = np.isin(dofs[:, nodes], last).any(axis=0).astype(float)[:, None]
        graph = csc_matrix(abs(graph) + csc_matrix(joined) @ csc_matrix(joined).T)
    graph.data[:] = -1.0
    graph = csc_matrix(graph + diags_array(np.full(nodes.size, 2.0 * np.diff(graph.indptr).max())))
    permutation = _factorise(graph, "MMD_AT_PLUS_A").perm_c
    order = np.empty_like(permutation)
    order[permutation] = np.arange(permutation.size)
    ordered = dofs[:, nodes[order]].T.ravel()
    ordered = ordered[free[ordered]]
    after = np.isin(ordered, [] if last is None else last)
    return np.concatenate([ordered[~after], ordered[after]])


def factorise(permuted: csc_matrix) -> SuperLU:
    """LU factors of a symmetric stiffness already in a fill-reducing order.

    Raises CondensationError if it is singular.
    """
    try:
        factors = _factorise(permuted, "NATURAL")
    except RuntimeError as error:  # a pivot is zero to the last bit
        raise CondensationError(SINGULAR) from error
    pivots = np.abs(factors.U.diagonal())
    if not pivots.min() >= PIVOT_LIMIT * pivots.max():
        raise CondensationError(SINGULAR)
    return factors


def _factorise(matrix: csc_matrix, ordering: str) -> SuperLU:
    """LU factors without pivoting, which a symmetric matrix far from singular does not need."""
    return splu(matrix, permc_spec=ordering, diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def backward_error(matrix: csc_matrix, field: FloatArray, load: FloatArray) -> float:
    """Backward error [1] of K u = f: max |K u - f| / (max row sum of |K| times max |u|). Rounding leaves some 1e-16."""
    scale = float(np.abs(matrix).sum(axis=1).max()) * float(np.abs(field).max())
    return float(np.abs(matrix @ field - load).max()) / scale
