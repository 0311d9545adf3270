"""Work and stiffness of hyperelastic tissue as scikit-fem forms in tensors: a second, independent assembly.

Coefficients of the forms: `state`, the displacement as an interpolated field, and lam, mu at quadrature points. With
F = I + grad u, G = F^-T, J = det F, I_1 = F : F + 1 and kappa = lam + 2 mu / 3 the first Piola-Kirchhoff stress is
    neo-Hookean  P = mu J^-2/3 (F - I_1/3 G) + kappa (J - 1) J G
    Green        P = F (lam tr(E) I + 2 mu E),        E = (F^T F - I)/2
    Hencky       P = G (lam ln J I + mu ln C),        C = F^T F
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from skfem import BilinearForm, LinearForm
from skfem.helpers import ddot, det, eye, grad, inv, mul, trace, transpose

from fingerpad.scene.tissue_law import Law

STEP = 1e-30  # of a complex step

Stress = Callable[[Any, Any], Any]
Change = Callable[[Any, Any, Any], Any]


def _unit(tensor: Any) -> Any:
    return eye(np.ones_like(tensor[0, 0]), 2)


def neo_hookean(F: Any, w: Any) -> Any:
    G, J, first, kappa = transpose(inv(F)), det(F), ddot(F, F) + 1.0, w.lam + 2.0 * w.mu / 3.0
    return w.mu * J ** (-2 / 3) * (F - first / 3.0 * G) + kappa * (J - 1.0) * J * G


def neo_hookean_change(F: Any, dF: Any, w: Any) -> Any:
    G, J, first, kappa = transpose(inv(F)), det(F), ddot(F, F) + 1.0, w.lam + 2.0 * w.mu / 3.0
    volume, turned = ddot(G, dF), mul(G, mul(transpose(dF), G))
    shape = dF - 2 / 3 * volume * (F - first / 3.0 * G) - 2 / 3 * ddot(F, dF) * G + first / 3.0 * turned
    return w.mu * J ** (-2 / 3) * shape + kappa * J * ((2.0 * J - 1.0) * volume * G - (J - 1.0) * turned)


def _second(strain: Any, w: Any) -> Any:
    return w.lam * trace(strain) * _unit(strain) + 2.0 * w.mu * strain


def green(F: Any, w: Any) -> Any:
    return mul(F, _second((mul(transpose(F), F) - _unit(F)) / 2.0, w))


def green_change(F: Any, dF: Any, w: Any) -> Any:
    half = mul(transpose(F), dF) / 2.0
    return mul(dF, _second((mul(transpose(F), F) - _unit(F)) / 2.0, w)) + mul(F, _second(half + transpose(half), w))


def hencky(F: Any, w: Any) -> Any:
    """ln C = (ln det C)/2 I + artanh(r)/r (C / m - I), with m = tr C / 2 and m r the radius of C's Mohr circle."""
    C, unit = mul(transpose(F), F), _unit(F)
    half = trace(C) / 2.0
    deviator = C / half - unit
    r = np.sqrt(ddot(deviator, deviator) / 2.0)
    logarithm = np.log(det(C)) / 2.0 * unit + np.arctanh(r) / r * deviator
    return mul(transpose(inv(F)), w.lam * np.log(det(F)) * unit + w.mu * logarithm)


def hencky_change(F: Any, dF: Any, w: Any) -> Any:
    return np.imag(hencky(F + 1j * STEP * dF, w)) / STEP


LAWS: dict[Law, tuple[Stress, Change]] = {
    Law.NEO_HOOKEAN: (neo_hookean, neo_hookean_change),
    Law.GREEN: (green, green_change),
    Law.HENCKY: (hencky, hencky_change),
}


def forms(law: Law) -> tuple[LinearForm, BilinearForm]:
    """Virtual work of the stress, and its derivative by the displacement."""
    stress, change = LAWS[law]

    def deformation(w: Any) -> Any:
        return grad(w.state) + _unit(grad(w.state))

    work = LinearForm(lambda v, w: ddot(stress(deformation(w), w), grad(v)))
    stiffness = BilinearForm(lambda u, v, w: ddot(change(deformation(w), grad(u), w), grad(v)))
    return work, stiffness
