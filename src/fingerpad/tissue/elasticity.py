"""Plane-strain linear elasticity: assembly of the stiffness, and the linear map from displacement to strain."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix, identity, kron
from skfem import Basis, BilinearForm, ElementTriP2, ElementVector, MeshTri2
from skfem.assembly import Dofs
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity

from ..arrays import FloatArray
from ..scene.finger import Material
from .compliance import GRADIENT

QUADRATURE_ORDER = 2  # exact for constant stress on curved second-order elements: grad (1) x adj J (1); degree count
MASS_ORDER = 4  # exact on straight second-order elements: phi (2) x phi (2); degree count
FACET_ENDS = np.array([[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [0.0, 1.0]], [[0.0, 0.0], [0.0, 1.0]]])  # of a triangle
GAUSS_POINTS = (1.0 + np.array([-1.0, 1.0]) / np.sqrt(3.0)) / 2.0  # on a facet of length 1 [1]


def lame(material: Material) -> tuple[float, float]:
    """Lamé constants (lambda, mu) [MPa] of plane strain: E nu / ((1 + nu)(1 - 2 nu)) and E / (2 (1 + nu)).

    >>> lame(Material(1.0, 0.0))
    (0.0, 0.5)
    """
    first, second = lame_parameters(material.modulus, material.poisson)
    return first, second


def displacement_basis(
    mesh: MeshTri2,
    elements: np.ndarray | None = None,
    points: tuple[FloatArray, FloatArray] | None = None,
    order: int = QUADRATURE_ORDER,
) -> Basis:
    """Basis of second-order displacements on a second-order mesh (isoparametric), or on some of its elements.

    points: where it is evaluated, as reference coordinates (2, n) and weights (n,), if not by quadrature of an order.
    """
    return Basis(mesh, ElementVector(ElementTriP2()), intorder=order, quadrature=points, elements=elements)


def node_dofs(basis: Basis | Dofs) -> np.ndarray:
    """Unknowns (2, n_nodes) of the nodes in the order of `mesh.doflocs`: vertices, then edge midpoints."""
    return np.hstack([basis.nodal_dofs, basis.facet_dofs])


def mesh_dofs(mesh: MeshTri2) -> np.ndarray:
    """`node_dofs` of a displacement basis on a mesh, or on some of its elements, without evaluating it."""
    return node_dofs(Dofs(mesh, ElementVector(ElementTriP2())))


def stiffness(basis: Basis, materials: Sequence[Material], element_material: np.ndarray) -> csc_matrix:
    """Stiffness matrix (n_unknowns, n_unknowns) [N/mm per mm of thickness].

    K_ij = ∫ sigma(phi_j) : eps(phi_i) dA with sigma = lambda tr(eps) I + 2 mu eps. element_material: (n_elements,)
    index into `materials`, over the basis's elements.
    """
    lam, mu = np.array([lame(material) for material in materials])[element_material].T[..., None]
    return csc_matrix(linear_elasticity(lam, mu).assemble(basis))


@BilinearForm
def _kinetic_energy(u, v, w):  # type: ignore[no-untyped-def]  # skfem's forms are untyped
    return dot(u, v)


def mass(mesh: MeshTri2, elements: np.ndarray | None, density: float) -> csc_matrix:
    """Mass matrix (n_unknowns, n_unknowns) [t per mm of thickness] of tissue of that density [t/mm3].

    M_ij = rho ∫ phi_i . phi_j dA.
    """
    basis = displacement_basis(mesh, elements, order=MASS_ORDER)
    return csc_matrix(density * _kinetic_energy.assemble(basis))


def strain_of_gradient(gradient: csr_matrix) -> csr_matrix:
    """Map (3n, ...) to exx, eyy and engineering shear gxy = 2 exy from one (4n, ...) to the displacement gradient."""
    own = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 1.0, 0.0]])
    return csr_matrix(kron(identity(gradient.shape[0] // GRADIENT), own) @ gradient)


def facet_strain(mesh: MeshTri2, facets: np.ndarray, element_of_facet: np.ndarray) -> tuple[FloatArray, csr_matrix]:
    """Positions (2, n_points) [mm] on facets, and the linear map (3 n_points, n_unknowns) to exx, eyy, gxy [1] there;
    see `facet_gradient`.
    """
    points, gradient = facet_gradient(mesh, facets, element_of_facet)
    return points, strain_of_gradient(gradient)


def facet_gradient(mesh: MeshTri2, facets: np.ndarray, element_of_facet: np.ndarray) -> tuple[FloatArray, csr_matrix]:
    """Displacement gradient on facets, as a linear map of the displacement.

    It is read at the two Gauss points of every facet, in the given adjacent element (facets carry two: this
    chooses the side). Gauss points are where the gradients of second-order elements are most accurate. They are placed
    here, as scikit-fem's `FacetBasis` finds them by Newton's method, which is lost in distorted elements.

    Returns positions (2, n_points) [mm], n_points = 2 n_facets ordered by facet, and the map
    (4 n_points, n_unknowns) to du_x/dx, du_x/dy, du_y/dx, du_y/dy [1], point by point.
    """
    rows, columns, entries = [], [], []
    positions = np.empty((2, facets.size, 2))
    local = np.argmax(mesh.t2f[:, element_of_facet] == facets, axis=0)
    for which, (start, stop) in enumerate(FACET_ENDS):
        chosen = np.flatnonzero(local == which)
        if chosen.size == 0:
            continue
        points = np.outer(start, 1.0 - GAUSS_POINTS) + np.outer(stop, GAUSS_POINTS)
        basis = displacement_basis(mesh, element_of_facet[chosen], (points, np.full(2, 0.5)))
        positions[:, chosen, :] = np.asarray(basis.global_coordinates())
        point = 2 * chosen[:, None] + np.arange(2)
        for function in range(basis.Nbfun):
            gradient = np.asarray(basis.basis[function][0].grad)
            for component, value in enumerate(gradient.reshape(GRADIENT, *point.shape)):
                rows.append((GRADIENT * point + component).ravel())
                columns.append(np.broadcast_to(basis.element_dofs[function][:, None], point.shape).ravel())
                entries.append(value.ravel())
    size = GRADIENT * 2 * facets.size
    unknowns = 2 * mesh.doflocs.shape[1]
    found = csr_matrix(
        (np.concatenate(entries), (np.concatenate(rows), np.concatenate(columns))), shape=(size, unknowns)
    )
    found.eliminate_zeros()
    return positions.reshape(2, -1), found


def unit_loads(dofs: np.ndarray, nodes: np.ndarray, size: int) -> csc_matrix:
    """Unit forces on both unknowns of some nodes (n,): a matrix (size, 2n) for `condense`."""
    return unit_forces(dofs[:, nodes].T.ravel(), size)


def unit_forces(unknowns: np.ndarray, size: int) -> csc_matrix:
    """Unit forces on some unknowns (k,) of `size`: a matrix (size, k) for `condense`."""
    return csc_matrix((np.ones(unknowns.size), (unknowns, np.arange(unknowns.size))), shape=(size, unknowns.size))
