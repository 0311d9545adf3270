"""Mean stress near incompressibility: from what elements bear on the whole, not from what their points say.

Second-order displacements alone hold the volume of every element, which is the mean of its points' dilatation; between
its points dilatation swings, and lambda times it the more. So the means over elements are kept, and each element's
field is the linear one that fits, by least squares, the means of all elements of its layer that share a vertex with it
(after Zienkiewicz and Zhu 1992, Int. J. Numer. Methods Eng. 33:1331; decision 20).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix
from skfem import Basis, MeshTri2

from ..arrays import FloatArray

COLLINEAR = 1e-8  # of a patch's moments [1], below which it has no gradient that way; source: rounding


def element_means(basis: Basis, values: FloatArray) -> FloatArray:
    """Means (n_elements,) over undeformed elements of values (n_elements, n_points) at a basis's quadrature points."""
    weight = basis.dx
    return (values * weight).sum(axis=1) / weight.sum(axis=1)


def recover_linear(basis: Basis, layer: np.ndarray, means: FloatArray, place: FloatArray) -> FloatArray:
    """Values (n_elements, k) at places (2, n_elements, k) [mm] of each element, of the fields that fit `means`.

    min sum of (m_j - a - g . (x_j - x))^2 / (A + |x_j - x|^2) over the elements j of the patch, x_j their centres, x
    and A the element's own centre and area. Patches in a line have no gradient across it. layer: (n_elements,) of each
    element; patches end where it does.
    """
    own, other = _patches(basis.mesh, layer)
    count = means.size
    centre = np.array([element_means(basis, each) for each in np.asarray(basis.global_coordinates())])
    size = np.sqrt(basis.dx.sum(axis=1))
    apart = (centre[:, other] - centre[:, own]) / size[own]
    terms = np.stack([np.ones(own.size), *apart])
    weighted = terms / (1.0 + (apart**2).sum(axis=0))
    right = np.stack([np.bincount(own, term * means[other], count) for term in weighted], axis=-1)
    moments = [[np.bincount(own, one * two, count) for two in terms] for one in weighted]
    inverse = np.linalg.pinv(np.moveaxis(np.array(moments), -1, 0), rcond=COLLINEAR, hermitian=True)
    middle, *slope = np.moveaxis((inverse @ right[..., None])[..., 0], -1, 0)[..., None]
    away = (place - centre[..., None]) / size[:, None]
    return middle + slope[0] * away[0] + slope[1] * away[1]


def _patches(mesh: MeshTri2, layer: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (n_pairs,) of elements of a layer that share a vertex, an element with itself among them."""
    count = mesh.t.shape[1]
    element = np.tile(np.arange(count), mesh.t.shape[0])
    at = csr_matrix((np.ones(element.size), (element, mesh.t.ravel())), shape=(count, mesh.nvertices))
    own, other = (at @ at.T).nonzero()
    same = layer[own] == layer[other]
    return own[same], other[same]
