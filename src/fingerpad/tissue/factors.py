"""Factors of a sparse symmetric stiffness: a fill-reducing order, LU factors in it, and what they leave of K u = f.

What is read of many solutions comes out of the factors themselves (as a Schur complement of an augmented matrix does,
Petra et al. 2014). With rows R below the stiffness K = L D L^T,
    [K 0; R I] = [L 0; Y I] [D L^T 0; 0 I],      Y = R L^-T D^-1,      R K^-1 R^T = Y D Y^T,
so that eliminating K once answers all loads R^T at once: a row of Y has entries only where elimination carries what
that row reads, and columns of Y with the same rows, as a supernode's, are one dense block of the product.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_array, csc_matrix, csr_matrix, diags_array, eye_array
from scipy.sparse.linalg import SuperLU, splu

from ..arrays import FloatArray
from ..errors import CondensationError

PIVOT_LIMIT = 1e-14  # of the largest pivot [1]; source: rounding; held tissue of contrast 1e6 stays above 1e-10

SINGULAR = "the stiffness is singular: nothing holds some of the tissue"


def fill_reducing_order(matrix: csc_matrix, dofs: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Fill-reducing order of the unknowns that are not held, found on the graph of nodes (an eighth of the work).

    dofs: (2, n_nodes) unknowns of the nodes. held: unknowns that do not move.
    """
    free = np.ones(matrix.shape[0], dtype=bool)
    free[held] = False
    nodes = np.flatnonzero(free[dofs].any(axis=0))
    first = dofs[0, nodes]
    graph = csc_matrix(matrix[first][:, first])
    graph.data[:] = -1.0
    graph = csc_matrix(graph + diags_array(np.full(nodes.size, 2.0 * np.diff(graph.indptr).max())))
    permutation = _factorise(graph, "MMD_AT_PLUS_A").perm_c
    order = np.empty_like(permutation)
    order[permutation] = np.arange(permutation.size)
    ordered = dofs[:, nodes[order]].T.ravel()
    return ordered[free[ordered]]


@dataclass(frozen=True)
class Factors:
    """LU factors of a stiffness with rows below it that are read of its solutions.

    lu: of both, without pivoting. size: of the stiffness. pivots: (size + n_rows,) in the order of elimination [N/mm
    per mm], 0 for the rows; as many are negative as eigenvalues of the stiffness. carried: (n_rows, size + n_rows) what
    L has in the rows.
    """

    lu: SuperLU
    size: int
    pivots: FloatArray
    carried: csc_matrix

    def solve(self, load: FloatArray) -> FloatArray:
        """K^-1 of a load (size,) or of some (size, k)."""
        padded = np.zeros((self.lu.shape[0], *load.shape[1:]), order="F")
        padded[: self.size] = load
        return self.lu.solve(padded)[: self.size]

    def read(self, count: int) -> FloatArray:
        """R K^-1 R_c^T (n_rows, count): what all rows read of the answers to the first `count` of them as loads."""
        found = np.zeros((self.carried.shape[0], count))
        for rows, block, pivot in _blocks(self.carried, self.pivots):
            own = np.searchsorted(rows, count)
            found[rows[:, None], rows[:own]] += (block.T * pivot) @ block[:, :own]
        return found


def _blocks(carried: csc_matrix, pivots: FloatArray) -> Iterator[tuple[np.ndarray, FloatArray, FloatArray]]:
    """Runs of neighbouring columns with entries in the same rows: these (k,), the entries (n, k), the pivots (n,)."""
    starts, rows = carried.indptr, carried.indices
    counts = np.diff(starts)
    before = rows[np.maximum(np.arange(rows.size) - np.repeat(counts, counts), 0)]
    other = np.logical_or.reduceat(np.append(rows != before, False), starts[:-1])  # of empty ones anything
    goes_on = np.zeros(counts.size, dtype=bool)
    goes_on[1:] = (counts[1:] == counts[:-1]) & ~other[1:]
    first = np.flatnonzero(~goes_on)
    for begin, end in zip(first, np.append(first[1:], counts.size), strict=True):
        if counts[begin] > 0:
            block = carried.data[starts[begin] : starts[end]].reshape(end - begin, -1)
            yield rows[starts[begin] : starts[begin + 1]], block, pivots[begin:end]


def factorise(permuted: csc_matrix, rows: csr_matrix | None = None) -> Factors:
    """LU factors of a symmetric stiffness already in a fill-reducing order. rows: (k, size) that are read of solutions.

    Raises CondensationError if it is singular.
    """
    bordered = permuted
    if rows is not None:
        bordered = csc_matrix(block_array([[permuted, None], [rows, eye_array(rows.shape[0])]]))
    try:
        lu = _factorise(bordered, "NATURAL")
    except RuntimeError as error:  # a pivot is zero to the last bit
        raise CondensationError(SINGULAR) from error
    size = permuted.shape[0]
    lower, upper = lu.L, lu.U
    pivots = upper.diagonal()
    own, border = np.split(lu.perm_c, [size])
    sizes = np.abs(pivots[own])
    if not (np.array_equal(lu.perm_r, lu.perm_c) and sizes.min() >= PIVOT_LIMIT * sizes.max()):
        raise CondensationError(SINGULAR)
    pivots[border] = 0.0
    carried = csc_matrix(lower[border])
    carried.sort_indices()
    _let_go(lower)
    _let_go(upper)
    return Factors(lu, size, pivots, carried)


def _let_go(copied: csc_matrix) -> None:
    """Empty a triangle that SuperLU copied out and keeps for as long as it lives, as large as its own."""
    copied.data, copied.indices = copied.data[:0].copy(), copied.indices[:0].copy()
    copied.indptr = np.zeros_like(copied.indptr)


def _factorise(matrix: csc_matrix, ordering: str) -> SuperLU:
    """LU factors without pivoting, which a symmetric matrix far from singular does not need."""
    return splu(matrix, permc_spec=ordering, diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def backward_error(matrix: csc_matrix, field: FloatArray, load: FloatArray) -> float:
    """Backward error [1] of K u = f: max |K u - f| / (max row sum of |K| times max |u|). Rounding leaves some 1e-16."""
    scale = float(np.abs(matrix).sum(axis=1).max()) * float(np.abs(field).max())
    return float(np.abs(matrix @ field - load).max()) / scale
