"""Cylinder on a half-plane (Hertz 1882): p = p0 sqrt(1 - x^2/a^2), p0 = 2 P / (pi a), a^2 = 4 P R / (pi E*)."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..contact.criterion import front
from ..contact.formulation import Status
from ..scene.device import ActuatorRow
from .blocks import HALF_WIDTH, TISSUE, face_means, half_plane, pressed
from .comparison import ACCURACY, Comparison, compare, refined

RADIUS = 5000.0 * HALF_WIDTH  # mm; Hertz neglects what is of the order of half-width over radius
CYLINDER = ActuatorRow((0.0,), 2.0 * RADIUS, RADIUS)
DEPTH = 7.5e-4  # mm; brings the contact's edge near HALF_WIDTH, where the mesh is fine
INCREMENTS = 4  # of pressing [1]; source: without friction the path does not matter, but Newton's start does
SPACINGS = (1 / 16, 1 / 32, 1 / 64)  # mm
INNER = 0.9  # of the half-width [1]; source: beyond, the pressure's slope grows without bound


def half_width(load: float, poisson: float) -> float:
    """Exact half-width a [mm] of contact under a load [N/mm], for E = 1 MPa: E* = 1 / (1 - nu^2)."""
    return float(np.sqrt(4.0 * load * RADIUS * (1.0 - poisson**2) / np.pi))


def pressure(load: float, width: float, x: FloatArray) -> FloatArray:
    """Exact pressure (n,) [MPa] at x (n,) [mm] under a load [N/mm] on a half-width [mm]."""
    return 2.0 * load / (np.pi * width) * np.sqrt(np.maximum(1.0 - (x / width) ** 2, 0.0))


def rows() -> list[Comparison]:
    """Half-width and pressure at the tissue's Poisson ratio."""
    return refined(hertz, SPACINGS)


def hertz(spacing: float, poisson: float = TISSUE) -> list[Comparison]:
    """Half-width, and pressure of nodes and elements over the inner nine tenths."""
    block = half_plane(spacing, spacing, poisson, CYLINDER, 0.0)
    state = pressed(block.problem, DEPTH, INCREMENTS)
    force = state.force[:, 1]
    load, mesh = float(force.sum()), (spacing, block.unknowns)
    width = half_width(load, poisson)
    x, nodal = block.problem.position[:, 0], force / block.weight
    exact = pressure(load, width, x)
    (middle, mean), (_, exact_mean) = face_means(block, nodal), face_means(block, exact)
    inner, within = np.abs(x) < INNER * width, np.abs(middle) < INNER * width
    case = f"Hertz, nu = {poisson:g}"
    return [
        compare(case, "half-width", mesh, front(x, state.gap, state.status != Status.OPEN), width, ACCURACY),
        compare(case, "nodal pressure", mesh, nodal[inner], exact[inner], ACCURACY),
        compare(case, "element pressure", mesh, mean[within], exact_mean[within], ACCURACY),
    ]
