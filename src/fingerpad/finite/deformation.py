"""Internal forces and tangent stiffness of deformed tissue: total Lagrangian, second-order elements.

With shape functions N_i, displacement gradient H = sum of u_i (x) grad N_i, F = I + H and stress S(E), from
`hyperelasticity`:
    f_i = ∫ F S grad N_i dA            K_ij = ∫ B_i^T D B_j + (grad N_i . S grad N_j) I dA,    B = dE/du
both over the undeformed section, with the quadrature of `elasticity`: at zero displacement K is the linear stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from skfem import Basis

from ..arrays import FloatArray
from ..errors import InvertedError
from ..tissue.compliance import VOIGT
from ..tissue.mesh import NODES
from .finite_strain import is_upright
from .hyperelasticity import Tissue, respond, stress_of

NODE_COUNT = NODES.shape[1]  # of a second-order triangle [1]


@dataclass(frozen=True)
class Elements:
    """Second-order elements of hyperelastic tissue, and where their entries go in the tangent.

    centre: (n_elements, 2) [mm]. shape_gradient: (n_elements, n_points, 6, 2) of the shape functions [1/mm]. gradient:
    (4 n_elements n_points, size) displacement gradient by the unknowns [1/mm], H_11, H_12, H_21 and H_22 of all points
    one after the other. weight: (n_elements, n_points) [mm2]. tissue: constants at (n_elements, 1).
    free: (n_free,) unknowns that move, in the order of the tangent's rows. rows, starts: of the tangent's columns
    (compressed). entry: (n_elements 144,) place of each element entry among them, the last for none.
    """

    centre: FloatArray
    shape_gradient: FloatArray
    gradient: csr_matrix
    weight: FloatArray
    tissue: Tissue
    free: np.ndarray
    rows: np.ndarray
    starts: np.ndarray
    entry: np.ndarray


def elements_of(basis: Basis, tissue: Tissue, free: np.ndarray) -> Elements:
    """Elements of a basis; `free` orders the tangent's rows and columns."""
    # (6, 2, n_elements, n_points)
    by_node = np.array([basis.basis[2 * node][0].grad[0] for node in range(NODE_COUNT)])
    shape_gradient = np.ascontiguousarray(by_node.transpose(2, 3, 0, 1))
    unknowns = basis.element_dofs.T  # x and y by node
    place = np.full(basis.N, free.size, dtype=np.int32)
    place[free] = np.arange(free.size)
    rows, starts, entry = _tangent_pattern(place[unknowns], free.size)
    return Elements(
        centre=basis.global_coordinates().mean(axis=-1).T,
        shape_gradient=shape_gradient,
        gradient=_displacement_gradient(shape_gradient, unknowns, basis.N),
        weight=basis.dx,
        tissue=tissue,
        free=free,
        rows=rows,
        starts=starts,
        entry=entry,
    )


def _displacement_gradient(shape_gradient: FloatArray, unknowns: np.ndarray, size: int) -> csr_matrix:
    """`gradient` of elements with those shape functions and unknowns (n_elements, 12)."""
    count, points, nodes, _ = shape_gradient.shape
    value = np.broadcast_to(shape_gradient.transpose(3, 0, 1, 2), (2, 2, count, points, nodes))
    column = np.broadcast_to(unknowns.reshape(count, 1, nodes, 2).transpose(3, 0, 1, 2)[:, None], value.shape)
    starts = np.arange(0, value.size + 1, nodes)
    return csr_matrix((value.ravel(), column.ravel(), starts), shape=(starts.size - 1, size))


def _tangent_pattern(place: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """`rows`, `starts` and `entry` of elements whose unknowns have these places (n_elements, 12), `size` for none.

    Entries are gathered by rows, as a matrix with repeated entries that holds their numbers; storing that by columns
    sorts them, in a time that does not grow faster than their number.
    """
    count = place.shape[1]
    order = np.argsort(place, axis=None, kind="stable")
    below = np.concatenate([[0], np.cumsum(np.bincount(place.ravel(), minlength=size + 1))])
    number = (count * order[:, None] + np.arange(count)).ravel()
    repeated = csr_matrix((number, place[order // count].ravel(), count * below), shape=(size + 1, size + 1)).tocsc()
    end = int(repeated.indptr[size])  # of what moves, but for the last rows
    row, number = repeated.indices[:end], repeated.data[:end]
    new = np.ones(end, dtype=bool)
    new[1:] = row[1:] != row[:-1]
    new[repeated.indptr[:size]] = True
    new &= row < size
    known = np.concatenate([[0], np.cumsum(new)])
    entry = np.full(place.size * count, known[-1])
    entry[number] = np.where(row < size, known[1:] - 1, known[-1])
    return row[new], known[repeated.indptr[: size + 1]].astype(np.int32), entry


def displacement_gradient(elements: Elements, displacement: FloatArray) -> FloatArray:
    """Displacement gradient (2, 2, n_elements, n_points) [1] of unknowns (size,) [mm].

    Raises InvertedError, with the first place, where elements are turned inside out.
    """
    gradient = (elements.gradient @ displacement).reshape(2, 2, *elements.weight.shape)
    inverted = ~is_upright(gradient).all(axis=-1)
    if inverted.any():
        x, y = elements.centre[np.flatnonzero(inverted)[0]]
        raise InvertedError(
            f"tissue is turned inside out in {np.count_nonzero(inverted)} elements, the first at x, y ="
            f" {x:.3f}, {y:.3f} mm"
        )
    return gradient


def internal_force(elements: Elements, displacement: FloatArray) -> FloatArray:
    """Forces (size,) [N/mm] that hold the tissue at a displacement (size,) [mm]. Raises InvertedError."""
    gradient = displacement_gradient(elements, displacement)
    stress = stress_of(elements.tissue, gradient)
    return elements.gradient.T @ (elements.weight * _first_stress(gradient, stress)).ravel()


def tangent_stiffness(elements: Elements, displacement: FloatArray) -> csc_matrix:
    """Tangent (n_free, n_free) [N/mm per mm], in the order of `free`, at a displacement (size,) [mm]. Raises
    InvertedError.
    """
    gradient = displacement_gradient(elements, displacement)
    response = respond(elements.tissue, gradient)
    (a, b), (c, d) = gradient[..., None]
    nx, ny = elements.shape_gradient[..., 0], elements.shape_gradient[..., 1]
    # rows of B, (n_elements, n_points, 3, 6, 2): derivatives of E_11, E_22 and 2 E_12 by the nodes' x and y
    strain = np.empty((*nx.shape[:2], VOIGT, NODE_COUNT, 2))
    strain[:, :, 0, :, 0], strain[:, :, 0, :, 1] = (1.0 + a) * nx, c * nx
    strain[:, :, 1, :, 0], strain[:, :, 1, :, 1] = b * ny, (1.0 + d) * ny
    strain[:, :, 2, :, 0], strain[:, :, 2, :, 1] = (1.0 + a) * ny + b * nx, c * ny + (1.0 + d) * nx
    strain = strain.reshape(*nx.shape[:2], VOIGT, 2 * NODE_COUNT)
    weighted = (response.tangent * elements.weight).transpose(2, 3, 0, 1)
    count = nx.shape[0]
    material = strain.reshape(count, -1, 2 * NODE_COUNT).transpose(0, 2, 1) @ (weighted @ strain).reshape(
        count, -1, 2 * NODE_COUNT
    )
    s11, s22, s12 = (response.stress * elements.weight)[..., None]
    pulled = np.stack([s11 * nx + s12 * ny, s12 * nx + s22 * ny], axis=-1)
    geometric = elements.shape_gradient.transpose(0, 2, 1, 3).reshape(count, NODE_COUNT, -1) @ pulled.transpose(
        0, 1, 3, 2
    ).reshape(count, -1, NODE_COUNT)
    blocks = material.reshape(count, NODE_COUNT, 2, NODE_COUNT, 2)
    blocks[:, :, 0, :, 0] += geometric
    blocks[:, :, 1, :, 1] += geometric
    data = np.bincount(elements.entry, blocks.ravel(), minlength=elements.rows.size + 1)[:-1]
    return csc_matrix((data, elements.rows, elements.starts), shape=(elements.free.size,) * 2)


def _first_stress(gradient: FloatArray, stress: FloatArray) -> FloatArray:
    """First Piola-Kirchhoff stress P = F S (2, 2, ...) [MPa]."""
    (a, b), (c, d) = gradient
    s11, s22, s12 = stress
    return np.array(
        [
            [(1.0 + a) * s11 + b * s12, (1.0 + a) * s12 + b * s22],
            [c * s11 + (1.0 + d) * s12, c * s12 + (1.0 + d) * s22],
        ]
    )
