"""Flat punch on a half-plane without friction (Sadowsky 1928): p = P / (pi sqrt(b^2 - x^2))."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..scene.device import SHARP_RADIUS, ActuatorRow
from .blocks import HALF_WIDTH, TISSUE, Block, face_means, half_plane, pressed
from .comparison import ACCURACY, Comparison, compare, refined

DEPTH = 1e-4 * HALF_WIDTH  # mm; far less than the drop of a sharp edge: contact ends there
# flat up to the vertex at the half-width: a sharp edge is rounded beyond it
PUNCH = ActuatorRow((0.0,), 2.0 * (HALF_WIDTH + SHARP_RADIUS), 0.0)
SPACINGS = (1 / 16, 1 / 32, 1 / 64)  # mm
EDGE = 0.125  # element length at the edge over that under the face [1]; source: the error is the edge's
INNER = 0.8 * HALF_WIDTH  # mm; source: beyond, the singular pressure changes within an element


def pressure(load: float, x: FloatArray) -> FloatArray:
    """Exact pressure (n,) [MPa] under a load [N/mm] at |x| < HALF_WIDTH (n,) [mm]."""
    return load / (np.pi * np.sqrt(HALF_WIDTH**2 - x**2))


def punched(spacing: float, poisson: float, friction: float) -> Block:
    """A half-plane under the punch, fine at the punch's edges."""
    return half_plane(spacing, EDGE * spacing, poisson, PUNCH, friction)


def rows() -> list[Comparison]:
    """Pressure over the inner four fifths, at the tissue's Poisson ratio."""
    return refined(flat_punch, SPACINGS)


def flat_punch(spacing: float, poisson: float = TISSUE) -> list[Comparison]:
    """Pressure of nodes and of elements, over the inner four fifths of the punch."""
    block = punched(spacing, poisson, 0.0)
    force = pressed(block.problem, DEPTH, 1).force[:, 1]
    load, mesh = float(force.sum()), (spacing, block.unknowns)
    x, nodal = block.problem.position[:, 0], force / block.weight
    inner, under = np.abs(x) < INNER, np.abs(x) < HALF_WIDTH
    exact = np.zeros(x.size)
    exact[under] = pressure(load, x[under])
    (middle, mean), (_, exact_mean) = face_means(block, nodal), face_means(block, exact)
    within = np.abs(middle) < INNER
    case = f"Flat punch, nu = {poisson:g}"
    return [
        compare(case, "nodal pressure", mesh, nodal[inner], exact[inner], ACCURACY),
        compare(case, "element pressure", mesh, mean[within], exact_mean[within], ACCURACY),
    ]
