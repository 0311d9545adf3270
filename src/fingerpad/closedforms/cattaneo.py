"""Partial slip of a pressed cylinder (Cattaneo 1938, Mindlin 1949): stick for |x| < c = a sqrt(1 - Q / (mu P)).

Traction: q = mu p0 (sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)), the second term inside the stick zone only. The
theory lets neither pressure move the surface sideways nor shear lift it (Goodman's approximation, exact at nu = 1/2),
presses without shear, and lets friction act from there; so does the problem that is solved.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import Status, switch_friction
from ..contact.path import follow
from .blocks import face_means, half_plane, lift, pressed
from .comparison import ACCURACY, Comparison, compare, refined
from .hertz import CYLINDER, DEPTH, INCREMENTS, INNER, SPACINGS, half_width, pressure

POISSON = 0.3  # [1]; source: chosen; without coupling the closed form holds for any
FRICTION = 0.5  # [1]; source: the same
SHIFT = 2.5e-4  # sideways [mm]; leaves the contact half stuck
SHIFT_INCREMENTS = 10  # [1]; source: the stick zone only shrinks, so more change nothing


def stick_half_width(width: float, ratio: float) -> float:
    """Exact half-width c [mm] of the stick zone, for a half-width a [mm] of contact and Q / (mu P) [1]."""
    return float(width * np.sqrt(1.0 - ratio))


def traction(load: float, width: float, stick: float, x: FloatArray) -> FloatArray:
    """Exact shear traction (n,) [MPa] at x (n,) [mm]; load [N/mm], half-widths of contact and stick zone [mm]."""
    inside = stick / width * pressure(load, width, x * width / stick)  # Hertz's ellipse, shrunk to the stick zone
    return FRICTION * (pressure(load, width, x) - inside)


def root_front(x: FloatArray, reserve: FloatArray) -> float:
    """Half-width [mm] at which what friction keeps in reserve, mu p - |q| (n,) [MPa] at x (n,) [mm], ends.

    It is half an ellipse over the stick zone, so its square is linear in x^2.
    """
    slope, start = np.polyfit(x**2, reserve**2, 1)
    return float(np.sqrt(-start / slope))


def rows() -> list[Comparison]:
    """Stick zone and shear traction."""
    return refined(cattaneo_mindlin, SPACINGS)


def cattaneo_mindlin(spacing: float) -> list[Comparison]:
    """Half-width of the stick zone, and shear traction of elements over the inner nine tenths of contact."""
    block = half_plane(spacing, spacing, POISSON, CYLINDER, 0.0)
    uncoupled = block.problem.compliance.copy()
    uncoupled[0::2, 1::2] = uncoupled[1::2, 0::2] = 0.0
    frictionless = replace(block.problem, compliance=uncoupled)
    normal = pressed(frictionless, DEPTH, INCREMENTS)
    stuck = switch_friction(normal)
    problem = replace(frictionless, friction=FRICTION)
    state = follow(problem, stuck, stuck.actuator + lift(problem, SHIFT, 0.0), SHIFT_INCREMENTS)

    load, mesh = float(state.force[:, 1].sum()), (spacing, block.unknowns)
    width = half_width(load, POISSON)
    stick = stick_half_width(width, abs(float(state.force[:, 0].sum())) / (FRICTION * load))
    middle, shear = face_means(block, np.abs(state.force[:, 0]) / block.weight)
    _, normal_pressure = face_means(block, state.force[:, 1] / block.weight)
    held = state.status == Status.STICK
    all_held = held[:-1] & held[1:]
    found = root_front(middle[all_held], (FRICTION * normal_pressure - shear)[all_held])
    inner = np.abs(middle) < INNER * width
    _, exact = face_means(block, traction(load, width, stick, block.problem.position[:, 0]))
    case = "Cattaneo-Mindlin"
    return [
        compare(case, "stick zone", mesh, found, stick, ACCURACY),
        compare(case, "element shear", mesh, shear[inner], exact[inner], ACCURACY),
    ]
