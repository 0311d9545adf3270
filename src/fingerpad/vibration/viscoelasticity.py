"""How tissue relaxes: a Prony series, the same for all layers that relax.

Held at a strain, the modulus falls from E0 to that of the scene, E, which is taken to be the relaxed one:
    E(t) = E0 (g + sum of g_i exp(-t / tau_i)),        g = 1 - sum of g_i,        E = g E0,
and in Laplace's transform, for motion exp(s t), the tissue is stiffer than relaxed by
    phi(s) = 1 + sum of r_i s tau_i / (1 + s tau_i),        r_i = g_i / g.
Poisson's ratio does not relax. Fung 1993, Biomechanics: Mechanical Properties of Living Tissues, chapter 7.
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray
from ..scene.vibration_rule import Relaxation


def stiffening(relaxation: Relaxation, rate: complex) -> complex:
    """Modulus over the relaxed one, phi(s) [1], at a rate s [1/s]: 0 if relaxed, infinity if at once, i omega for a
    vibration.

    >>> stiffening(Relaxation((0.5,), (1.0,), ("dermis",)), 1.0)
    (1.5+0j)
    """
    ratios, times = _ratios(relaxation), np.asarray(relaxation.times)
    if math.isinf(abs(rate)):
        return complex(1.0 + ratios.sum())
    return complex(1.0 + np.sum(ratios * rate * times / (1.0 + rate * times)))


def retardation_times(relaxation: Relaxation) -> FloatArray:
    """Times (k,) [s], ascending, in which the strain of such a material creeps under a stress: where phi(-1/t) = 0.

    >>> retardation_times(Relaxation((0.5,), (1.0,), ("dermis",))).tolist()
    [2.0]
    """
    times = np.asarray(relaxation.times)
    # the terms follow tau_i v_i' = e - v_i; without stress (1 + sum r) e = r.v, so that v' = -((I + 1 r^T) tau)^-1 v,
    # with the eigenvalues of tau (I + 1 r^T)
    system = np.diag(times) @ (np.eye(times.size) + np.outer(np.ones(times.size), _ratios(relaxation)))
    return np.sort(np.linalg.eigvals(system).real)


def _ratios(relaxation: Relaxation) -> FloatArray:
    """Shares of the terms over that which stays, r_i [1]."""
    shares = np.asarray(relaxation.shares)
    return shares / (1.0 - shares.sum())
