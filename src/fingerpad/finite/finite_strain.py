"""Strains of large displacement gradients H_ij = du_i/dX_j in plane strain.

Green's strain E = (H + H^T + H^T H) / 2 and Hencky's, ln U = ln(I + 2 E) / 2, do not see a rotation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray

# Least ratio [1] of stretches. Source: squares of stretches are differences of numbers as large as that of the larger
# one, of which 1e-14 is some fifty roundings
FLAT = 1e-7


@dataclass(frozen=True)
class Principal:
    """Principal values (2, ...) of Green's strain, largest first, and cosine and sine (...) of the first axis."""

    values: FloatArray
    cosine: FloatArray
    sine: FloatArray


def green_strain(gradient: FloatArray) -> FloatArray:
    """Green's strain (3, ...) E_11, E_22, 2 E_12 [1] of displacement gradients (2, 2, ...)."""
    (a, b), (c, d) = gradient
    return np.stack([a + (a * a + c * c) / 2.0, d + (b * b + d * d) / 2.0, b + c + a * b + c * d])


def principal_strain(gradient: FloatArray) -> Principal:
    """Principal values and axes of Green's strain of displacement gradients (2, 2, ...)."""
    strain = green_strain(gradient)
    middle, half = (strain[0] + strain[1]) / 2.0, (strain[0] - strain[1]) / 2.0
    radius = np.hypot(half, strain[2] / 2.0)
    angle = np.arctan2(strain[2] / 2.0, half) / 2.0
    return Principal(np.stack([middle + radius, middle - radius]), np.cos(angle), np.sin(angle))


def logarithmic_strain(gradient: FloatArray) -> FloatArray:
    """Hencky's strain ln U (3, ...), e_11, e_22, 2 e_12 [1], of displacement gradients (2, 2, ...).

    >>> logarithmic_strain(np.array([[np.e - 1.0, 0.0], [0.0, 0.0]])).round(12).tolist()
    [1.0, 0.0, 0.0]
    """
    axes = principal_strain(gradient)
    first, second = np.log1p(2.0 * axes.values) / 2.0
    cc, ss, cs = axes.cosine**2, axes.sine**2, axes.cosine * axes.sine
    return np.stack([cc * first + ss * second, ss * first + cc * second, 2.0 * cs * (first - second)])


def is_upright(gradient: FloatArray) -> NDArray[np.bool_]:
    """Where (...) the determinant of F = I + H is positive, of gradients H (2, 2, ...), by so much that the smaller
    stretch does not drown in rounding: det F > FLAT (1 + tr F^T F).
    """
    (a, b), (c, d) = gradient
    first, last = 1.0 + a, 1.0 + d
    return first * last - b * c > FLAT * (1.0 + first * first + b * b + c * c + last * last)
