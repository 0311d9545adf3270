"""Flat punch pressed with friction (Spence 1973): the stick zone |x| < c is the same at every load.

A half-plane under pressure p and shear q moves by (Johnson 1985, eqs 2.25; A = 2 (1 - nu^2) / E,
gamma = (1 - 2 nu) / (2 (1 - nu)))
    u_x' = -A (gamma p + H q),    u_y' = -A (H p - gamma q),    H f = (1/pi) PV int f(s) / (x - s) ds.
Under the punch u_y' = 0; u_x = 0 where it sticks; q = mu p sign(x) where it slips. If shear lifts nothing (gamma q
is left out of u_y'), p is the frictionless punch's, and q is bounded at c only if
    K'(c/b) / K(c/b) = gamma / mu,
with K the complete elliptic integral and K' that of the complementary modulus. With shear as well, c is the eigenvalue
of an integral equation without closed form; it is solved here by collocation, which gives back the elliptic integrals'
c when shear lifts nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipk, ellipkm1

from ..arrays import FloatArray
from ..contact.formulation import ContactProblem, Status
from .blocks import HALF_WIDTH, pressed
from .comparison import Comparison, compare, refined
from .punch import DEPTH, punched

CASES = ((0.3, 0.2), (0.0, 0.4))  # Poisson's ratio and friction [1]: weak coupling and the strongest, both half stuck
FRONT_NODES = 4  # nodes next to the front from which it is extrapolated [1]
SPACINGS = (1 / 32, 1 / 64, 1 / 128)  # mm
FRONT_TOLERANCE = 0.5  # of an element [1]: half the distance between the two nodes that the front lies between
BRACKET = (0.05, 0.95)  # c / b [1]; source: holds the eigenvalues of CASES
FINE = 1e-6  # shortest panel over the zone it belongs to [1]; source: 1e-8 changes c by less than 1e-5
PANEL_GROWTH = 0.2  # of neighbouring panels [1]; source: 0.05 changes c by less than 1e-4


def coupling(poisson: float) -> float:
    """Gamma [1]: surface strain by pressure over slope by shear."""
    return (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson))


def uncoupled_ratio(gamma: float, friction: float) -> float:
    """c / b [1] if shear lifts nothing: K'(c/b) / K(c/b) = gamma / friction.

    >>> round(uncoupled_ratio(0.3, 0.3) ** 2, 12)  # K' = K at equal moduli
    0.5
    """

    def excess(complement: float) -> float:  # 1 - (c/b)^2, which keeps its digits where the punch all but sticks
        return float(gamma * ellipkm1(complement) - friction * ellipk(complement))

    tiny = np.finfo(float).tiny
    return float(np.sqrt(1.0 - brentq(excess, tiny, 1.0 - np.finfo(float).eps, xtol=tiny)))


def coupled_ratio(gamma: float, friction: float, lift: bool = True) -> float:
    """c / b [1] by collocation; lift: whether shear lifts the surface."""
    return float(brentq(lambda ratio: _imbalance(_panels(ratio), gamma, friction, lift), *BRACKET, xtol=FINE))


@dataclass(frozen=True)
class _Panels:
    """Panels of constant traction on 0 < x < b = 1. ends: (n + 1,). stick: how many of them lie in the stick zone."""

    ends: FloatArray
    stick: int


def _panels(ratio: float) -> _Panels:
    """Panels that shorten towards both sides of c and towards b, where tractions are not smooth."""
    inside = ratio - _graded(ratio, FINE * ratio)[::-1]
    half = _graded((1.0 - ratio) / 2.0, FINE * (1.0 - ratio))
    return _Panels(np.concatenate([inside, ratio + half[1:], 1.0 - half[-2::-1]]), inside.size - 1)


def _graded(length: float, fine: float) -> FloatArray:
    """Coordinates from 0 to `length`; the first step is at most `fine`, each further one wider by PANEL_GROWTH."""
    count = int(np.ceil(np.log1p(PANEL_GROWTH * length / fine) / np.log1p(PANEL_GROWTH)))
    distance = np.expm1(np.arange(count + 1) * np.log1p(PANEL_GROWTH))
    return length * distance / distance[-1]


def _imbalance(panels: _Panels, gamma: float, friction: float, lift: bool) -> float:
    """Shear beyond the friction limit at the end of the stick zone [1 / b]: zero where the zone ends.

    Pressure and slope are those of a unit load. Tractions are constant on panels, displacements hold at their middles.
    p is even and q odd in x, so each panel acts together with its mirror image.
    """
    ends, stick = panels.ends, panels.stick
    middle, length = (ends[1:] + ends[:-1]) / 2.0, np.diff(ends)
    count = middle.size
    own = _log_integral(ends[1:] - middle[:, None]) - _log_integral(ends[:-1] - middle[:, None])
    image = _log_integral(ends[1:] + middle[:, None]) - _log_integral(ends[:-1] + middle[:, None])
    even, odd = (own + image) / np.pi, (own - image) / np.pi
    before = np.tril(np.ones((count, count)), -1) * length + np.diag(length / 2.0)  # int_0^x of a traction
    slope = gamma if lift else 0.0

    # unknowns: p on all panels, q on those that stick, and how deep the punch is; q = mu p on the others
    matrix = np.zeros((count + stick + 1,) * 2)
    matrix[:count, :count] = -even
    matrix[:count, stick:count] += slope * friction * before[:, stick:]
    matrix[:count, count:-1] = slope * before[:, :stick]
    matrix[:count, -1] = -1.0
    matrix[count:-1, :count] = -gamma * before[:stick]
    matrix[count:-1, stick:count] -= friction * odd[:stick, stick:]
    matrix[count:-1, count:-1] = -odd[:stick, :stick]
    matrix[-1, :count] = 2.0 * length
    right = np.zeros(count + stick + 1)
    right[-1] = 1.0
    answer = np.linalg.solve(matrix, right)
    return float(answer[-2] - friction * answer[stick - 1])


def _log_integral(distance: FloatArray) -> FloatArray:
    """Antiderivative of ln |d|, shape kept."""
    return distance * np.log(np.abs(distance)) - distance


def rows() -> list[Comparison]:
    """Stick zones without and with the lift by shear."""
    return refined(spence, SPACINGS)


def spence(spacing: float) -> list[Comparison]:
    """Half-widths of the stick zone for all CASES."""
    found = []
    for poisson, friction in CASES:
        gamma = coupling(poisson)
        block = punched(spacing, poisson, friction)
        mesh = spacing, block.unknowns
        unlifted = block.problem.compliance.copy()
        unlifted[1::2, 0::2] = 0.0
        case = f"Spence, nu = {poisson:g}, mu = {friction:g}"
        for quantity, problem, exact in (
            ("stick zone, no lift", replace(block.problem, compliance=unlifted), uncoupled_ratio(gamma, friction)),
            ("stick zone", block.problem, coupled_ratio(gamma, friction)),
        ):
            front = _stick_front(problem, block.weight)
            wanted = exact * HALF_WIDTH
            found.append(compare(case, quantity, mesh, front, wanted, FRONT_TOLERANCE * spacing / wanted))
    return found


def _stick_front(problem: ContactProblem, weight: FloatArray) -> float:
    """Half-width of the stick zone [mm] between nodes, after pressing in one step: all loads look alike.

    What friction keeps in reserve, mu p - |q|, ends like a square root, so its square is extrapolated to zero.
    """
    state = pressed(problem, DEPTH, 1)
    x = problem.position[:, 0]
    reserve = (problem.friction * state.force[:, 1] - np.abs(state.force[:, 0])) / weight
    near = np.flatnonzero(state.status == Status.STICK)[-FRONT_NODES:]
    slope, start = np.polyfit(x[near], reserve[near] ** 2, 1)
    return float(-start / slope)
