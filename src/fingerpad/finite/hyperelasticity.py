"""Hyperelasticity of isotropic tissue in plane strain: stress and tangent from principal logarithmic strains.

With the principal values E_a of Green's strain the stretches are lambda_a = sqrt(1 + 2 E_a); out of the plane the
stretch is 1. Every law is a stored energy W of the principal logarithmic strains e_a = ln lambda_a:
    tau_a = dW/de_a                    Kirchhoff stress; c_ab = d tau_a/de_b its stiffness
    S_a = tau_a / lambda_a^2           second Piola-Kirchhoff stress, coaxial with E
    dS_a/dE_b = (c_ab - 2 tau_a delta_ab) / (lambda_a^2 lambda_b^2),     dS_12 = (S_1 - S_2)/(E_1 - E_2) dE_12
the last along the principal axes, as they turn (Ogden 1984, Non-linear Elastic Deformations, section 6.1; Bonet and
Wood 2008, Nonlinear Continuum Mechanics for Finite Element Analysis, section 6.6). At zero strain every law is the
linear one of `elasticity`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..scene.finger import Material
from ..scene.scene import Scene
from ..scene.tissue_law import Law
from ..tissue.elasticity import lame
from .finite_strain import Principal, green_strain, principal_strain

EQUAL = 1e-6  # difference of principal strains [1] below which its limit serves; source: it is off by the square


@dataclass(frozen=True)
class Tissue:
    """A law and its constants at points of any shape (...): lam, mu [MPa]; exponent of Ogden's law [1]."""

    law: Law
    lam: FloatArray
    mu: FloatArray
    exponent: float


@dataclass(frozen=True)
class Response:
    """Stress and tangent at points (...).

    stress: (3, ...) second Piola-Kirchhoff stress S_11, S_22, S_12 [MPa]. tangent: (3, 3, ...) its derivative by
    Green's strain E_11, E_22, 2 E_12 [MPa].
    """

    stress: FloatArray
    tangent: FloatArray


def tissue_of(law: Law, exponent: float, materials: Sequence[Material], index: np.ndarray) -> Tissue:
    """Tissue whose points (...) have the materials of that index (...)."""
    constants = np.array([lame(material) for material in materials])[index]
    return Tissue(law, constants[..., 0], constants[..., 1], exponent)


def scene_tissue(scene: Scene, layer: np.ndarray) -> Tissue:
    """A scene's tissue with finite kinematics, whose points (...) lie in the layers of that index (...)."""
    law = scene.model.tissue
    return tissue_of(law.law, law.ogden_exponent, scene.model.finger.materials, layer)


def stress_of(tissue: Tissue, gradient: FloatArray) -> FloatArray:
    """Second Piola-Kirchhoff stress (3, ...) S_11, S_22, S_12 [MPa] of tissue at displacement gradients (2, 2, ...).

    Coaxial with E, it is S = m I + t (E - e I) with m, e the mean principal values and t = (S_1 - S_2)/(E_1 - E_2).
    """
    strain = green_strain(gradient)
    middle, half, shear = (strain[0] + strain[1]) / 2.0, (strain[0] - strain[1]) / 2.0, strain[2] / 2.0
    radius = np.sqrt(half * half + shear * shear)
    values = np.stack([middle + radius, middle - radius])
    principal = _kirchhoff(tissue, values)[0] / (1.0 + 2.0 * values)
    mean, difference = (principal[0] + principal[1]) / 2.0, (principal[0] - principal[1]) / 2.0
    slope = difference / np.maximum(radius, np.finfo(float).tiny)
    return np.stack([mean + slope * half, mean - slope * half, slope * shear])


def respond(tissue: Tissue, gradient: FloatArray) -> Response:
    """Stress and tangent of tissue at displacement gradients (2, 2, ...)."""
    axes = principal_strain(gradient)
    square = 1.0 + 2.0 * axes.values
    tau, (c11, c12, c22) = _kirchhoff(tissue, axes.values)
    stress = tau / square
    d11 = (c11 - 2.0 * tau[0]) / square[0] ** 2
    d22 = (c22 - 2.0 * tau[1]) / square[1] ** 2
    d12 = c12 / (square[0] * square[1])
    apart = axes.values[0] - axes.values[1]
    equal = apart < EQUAL
    limit = (d11 + d22) / 2.0 - d12
    turning = np.where(equal, limit, (stress[0] - stress[1]) / np.where(equal, 1.0, apart)) / 2.0
    return Response(stress_of(tissue, gradient), _turned(axes, d11, d22, d12, turning))


def cauchy_stress(tissue: Tissue, gradient: FloatArray) -> FloatArray:
    """Cauchy stress (4, ...) xx, yy, zz, xy [MPa] at displacement gradients (2, 2, ...): F S F^T / J in the plane, and
    dW/de_3 / J out of it.
    """
    (a, b), (c, d) = gradient
    f11, f22 = 1.0 + a, 1.0 + d
    s11, s22, s12 = stress_of(tissue, gradient)
    kirchhoff = [
        f11 * f11 * s11 + b * b * s22 + 2.0 * f11 * b * s12,
        c * c * s11 + f22 * f22 * s22 + 2.0 * c * f22 * s12,
        _out_of_plane(tissue, principal_strain(gradient).values),
        f11 * c * s11 + b * f22 * s22 + (f11 * f22 + b * c) * s12,
    ]
    return np.stack(kirchhoff) / (f11 * f22 - b * c)


def _out_of_plane(tissue: Tissue, strain: FloatArray) -> FloatArray:
    """Kirchhoff stress (...) along the axis that is not strained [MPa], at principal Green's strains (2, ...)."""
    if tissue.law is Law.GREEN:
        return tissue.lam * (strain[0] + strain[1])
    log = np.log1p(2.0 * strain) / 2.0
    volume = log[0] + log[1]
    if tissue.law is Law.HENCKY:
        return tissue.lam * volume
    alpha = tissue.exponent if tissue.law is Law.OGDEN else 2.0
    growth = np.expm1(volume)
    mean = (np.expm1(alpha * log[0]) + np.expm1(alpha * log[1])) / 3.0
    bulk = tissue.lam + 2.0 * tissue.mu / 3.0
    return bulk * growth * (1.0 + growth) - 2.0 * tissue.mu / alpha * np.exp(-alpha / 3.0 * volume) * mean


def _kirchhoff(tissue: Tissue, strain: FloatArray) -> tuple[FloatArray, tuple[FloatArray, FloatArray, FloatArray]]:
    """Kirchhoff stress (2, ...) and its stiffness c_11, c_12, c_22 [MPa] at principal Green's strains (2, ...)."""
    lam, mu = tissue.lam, tissue.mu
    if tissue.law is Law.GREEN:
        square = 1.0 + 2.0 * strain
        second = lam * (strain[0] + strain[1]) + 2.0 * mu * strain
        own = square * (square * (lam + 2.0 * mu) + 2.0 * second)
        return square * second, (own[0], square[0] * square[1] * lam, own[1])
    log = np.log1p(2.0 * strain) / 2.0
    volume = log[0] + log[1]
    if tissue.law is Law.HENCKY:
        return lam * volume + 2.0 * mu * log, (lam + 2.0 * mu, lam, lam + 2.0 * mu)
    alpha = tissue.exponent if tissue.law is Law.OGDEN else 2.0
    power = np.expm1(alpha * log)  # lambda^alpha - 1, without cancellation
    growth = np.expm1(volume)  # J - 1
    bulk = lam + 2.0 * mu / 3.0
    scale = 2.0 * mu / alpha * np.exp(-alpha / 3.0 * volume)
    mean = (power[0] + power[1]) / 3.0
    tau = scale * (power - mean) + bulk * growth * (1.0 + growth)
    stiffening = bulk * (1.0 + growth) * (1.0 + 2.0 * growth)
    third = (1.0 + mean) / 3.0  # a ninth of the sum of all three powers
    own = alpha * scale * ((1.0 + power) / 3.0 + third) + stiffening
    other = alpha * scale * (third - (2.0 + power[0] + power[1]) / 3.0) + stiffening
    return tau, (own[0], other, own[1])


def _turned(axes: Principal, d11: FloatArray, d22: FloatArray, d12: FloatArray, turning: FloatArray) -> FloatArray:
    """Tangent (3, 3, ...) in x, y of that along the axes, where S_12 over 2 E_12 is `turning`."""
    c, s = axes.cosine, axes.sine
    cc, ss, cs = c * c, s * s, c * s
    # rows: principal E_11, E_22, 2 E_12 of E_11, E_22, 2 E_12 in x, y
    first, second, shear = np.stack([cc, ss, cs]), np.stack([ss, cc, -cs]), np.stack([-2.0 * cs, 2.0 * cs, cc - ss])
    tangent = first[:, None] * (d11 * first + d12 * second)
    tangent += second[:, None] * (d12 * first + d22 * second)
    tangent += shear[:, None] * (turning * shear)
    return tangent
