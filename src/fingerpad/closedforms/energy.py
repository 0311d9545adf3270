"""Stored energies written in the deformation gradient alone, and the stress that follows by the complex step.

With C = F^T F, J = det F, m = tr C / 2 and r^2 = ((C_11 - C_22) / 2)^2 + C_12^2, the principal logarithmic strains have
    e_1 + e_2 = ln J        e_1 - e_2 = artanh(r / m)
and an isotropic energy is even in r, so that it is analytic in F also where the principal stretches are equal:
    P_ij = dW/dF_ij = Im W(F + i h e_ij) / h        to rounding (Squire and Trapp 1998)
Nothing here is shared with `hyperelasticity`, which is held to it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from ..finite.hyperelasticity import Tissue
from ..scene.tissue_law import Law

STEP = 1e-30  # of the complex step [1]; source: any whose square is lost beside 1 and is not zero
PLANE = ((0, 0), (0, 1), (1, 0), (1, 1))  # components of a gradient


def stored_energy(tissue: Tissue, gradient: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Stored energy (...) [MPa] at displacement gradients (2, 2, ...), real or complex."""
    (a, b), (c, d) = np.asarray(gradient, dtype=complex)
    f11, f22 = 1.0 + a, 1.0 + d
    c11, c22, c12 = f11 * f11 + c * c, b * b + f22 * f22, f11 * b + c * f22
    lam, mu = tissue.lam, tissue.mu
    if tissue.law is Law.GREEN:
        e11, e22, e12 = (c11 - 1.0) / 2.0, (c22 - 1.0) / 2.0, c12 / 2.0
        return lam / 2.0 * (e11 + e22) ** 2 + mu * (e11**2 + e22**2 + 2.0 * e12**2)
    jacobian = f11 * f22 - b * c
    apart = np.arctanh(np.sqrt(((c11 - c22) / 2.0) ** 2 + c12**2) / ((c11 + c22) / 2.0))
    volume = np.log(jacobian)
    if tissue.law is Law.HENCKY:
        return lam / 2.0 * volume**2 + mu / 2.0 * (volume**2 + apart**2)
    alpha = tissue.exponent if tissue.law is Law.OGDEN else 2.0
    powers = jacobian ** (alpha / 2.0) * 2.0 * np.cosh(alpha / 2.0 * apart) + 1.0  # the last: no stretch out of plane
    shape = 2.0 * mu / alpha**2 * (jacobian ** (-alpha / 3.0) * powers - 3.0)
    return shape + (lam + 2.0 * mu / 3.0) / 2.0 * (jacobian - 1.0) ** 2


def first_stress(tissue: Tissue, gradient: FloatArray) -> FloatArray:
    """First Piola-Kirchhoff stress (2, 2, ...) [MPa] at displacement gradients (2, 2, ...)."""
    stress = np.empty(np.broadcast_shapes(gradient.shape, (2, 2, *np.shape(tissue.lam))))
    for i, j in PLANE:
        moved = np.asarray(gradient, dtype=complex)
        moved[i, j] += 1j * STEP
        stress[i, j] = stored_energy(tissue, moved).imag / STEP
    return stress
