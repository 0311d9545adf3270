"""Contact tractions on a face of second-order elements: linear between vertices.

Second-order displacements with linear tractions are a stable pair: pressures do not swing between vertices and
midpoints, however incompressible the tissue is, and half the unknowns remain. Each vertex j has the hat function
psi_j; its force f_j is the resultant of the traction t_j psi_j, f_j = t_j D_j with D_j = ∫ psi_j ds. Nodes see the
forces W f with W_ij = ∫ phi_i psi_j ds / D_j, and by duality the displacement that belongs to f_j is the mean of the
skin's, weighted with psi_j: W^T u.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array, kron

from ..arrays import FloatArray


@dataclass(frozen=True)
class Tractions:
    """Tractions on k elements with n nodes and m vertices.

    nodes: (n,) nodes of the elements in the order of the face. loads: (n, m) nodal forces of unit resultants, W.
    position: (m, 2) means of the undeformed nodes [mm]. weight: (m,) length D of skin [mm].
    """

    nodes: np.ndarray
    loads: csr_array
    position: FloatArray
    weight: FloatArray

    def by_component(self) -> csr_array:
        """W for both components, rows and columns ordered x0, y0, x1, y1, ... (2n, 2m)."""
        return csr_array(kron(self.loads, np.eye(2)))


def linear_tractions(face: np.ndarray, points: FloatArray, loaded: np.ndarray) -> Tractions:
    """Tractions on some elements of a face.

    face: (2k + 1,) nodes along it, vertices and midpoints alternating. points: (2, 2k + 1) their places [mm]. loaded:
    (k,) which elements carry tractions.
    """
    length = np.where(loaded, np.hypot(*(points[:, 2::2] - points[:, :-2:2])), 0.0)
    count = length.size
    # of one element of length l, ∫ phi_i psi_j ds: l/6 for a vertex's own, l/3 for the midpoint's with either, 0 across
    own, middle = length / 6.0, length / 3.0
    left, right = np.append(0.0, length), np.append(length, 0.0)  # of each vertex
    weight = (left + right) / 2.0
    first = points[:, :-2:2] * own + points[:, 1::2] * middle
    last = points[:, 2::2] * own + points[:, 1::2] * middle
    nothing = np.zeros((2, 1))
    moment = np.hstack([first, nothing]) + np.hstack([nothing, last])

    element, vertex = np.arange(count), 2 * np.arange(count + 1)
    rows = np.concatenate([vertex, 2 * element + 1, 2 * element + 1])
    columns = np.concatenate([np.arange(count + 1), element, element + 1])
    entries = np.concatenate([(left + right) / 6.0, middle, middle])
    bearing = np.flatnonzero(weight > 0.0)
    nodes = np.union1d(2 * bearing, 2 * np.flatnonzero(loaded) + 1)
    whole = csr_array((entries, (rows, columns)), shape=(face.size, count + 1))
    loads = whole[nodes][:, bearing] @ diags_array(1.0 / weight[bearing])
    return Tractions(face[nodes], csr_array(loads), (moment[:, bearing] / weight[bearing]).T, weight[bearing])
