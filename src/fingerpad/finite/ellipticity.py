"""Whether deformed tissue is elliptic: where it is not, strain gathers in bands as thin as an element.

A small movement that varies along the direction N of the undeformed section meets the acoustic tensor
    Q_ik(N) = dP_iJ/dF_kL N_J N_L = (B_N^T C B_N)_ik + (N . S N) delta_ik,
P the first and S the second Piola-Kirchhoff stress, C = dS/dE, and B_N what takes u to the change of E by u (x) N.
Tissue is strongly elliptic where Q is positive for all N (Hadamard; Marsden and Hughes 1983, Mathematical Foundations
of Elasticity, section 3.4). Where it is not no mesh agrees with a finer one (docs/decisions/0022).
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..errors import EllipticityError
from ..scene.tissue_law import Law
from .deformation import Elements, displacement_gradient
from .hyperelasticity import Tissue, respond

DIRECTIONS = 24  # looked along, of half a turn [1]; source: twice as many find the same in simple shear, to 0.3 % of it


def require_elliptic(elements: Elements, displacement: FloatArray) -> None:
    """Raise EllipticityError, with the first place, if tissue with displacements (size,) [mm] is not elliptic; and
    InvertedError as `displacement_gradient`.
    """
    lost = smallest_stiffness(elements.tissue, displacement_gradient(elements, displacement)).min(axis=-1) <= 0.0
    if lost.any():
        x, y = elements.centre[np.flatnonzero(lost)[0]]
        other = "" if elements.tissue.law is Law.NEO_HOOKEAN else f", or tissue.law: {Law.NEO_HOOKEAN}"
        raise EllipticityError(
            f"the tissue's law is no longer elliptic in {np.count_nonzero(lost)} elements, the first at x, y ="
            f" {x:.3f}, {y:.3f} mm: strain gathers there in bands as thin as the mesh; try less indentation{other}"
        )


def smallest_stiffness(tissue: Tissue, gradient: FloatArray) -> FloatArray:
    """Smallest eigenvalue (...) [MPa] of the acoustic tensor over all directions, at displacement gradients
    (2, 2, ...).

    >>> at_rest = Tissue(Law.HENCKY, np.array(1.0), np.array(0.5), 2.0)
    >>> float(smallest_stiffness(at_rest, np.zeros((2, 2))).round(12))
    0.5
    """
    response = respond(tissue, gradient)
    (a, b), (c, d) = gradient
    smallest = np.full(a.shape, np.inf)
    for angle in np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        nx, ny = np.cos(angle), np.sin(angle)
        # columns of B_N: changes of E_11, E_22 and 2 E_12 by movements along x and along y
        strain = np.array(
            [
                [(1.0 + a) * nx, c * nx],
                [b * ny, (1.0 + d) * ny],
                [(1.0 + a) * ny + b * nx, c * ny + (1.0 + d) * nx],
            ]
        )
        xx, xy, yy = (
            np.einsum("p...,pq...,q...->...", strain[:, i], response.tangent, strain[:, k])
            for i, k in ((0, 0), (0, 1), (1, 1))
        )
        s11, s22, s12 = response.stress
        pulled = nx * nx * s11 + ny * ny * s22 + 2.0 * nx * ny * s12
        lower = (xx + yy) / 2.0 - np.hypot((xx - yy) / 2.0, xy) + pulled
        smallest = np.minimum(smallest, lower)
    return smallest
