"""The certificate of a solution: it is kept if it obeys the laws it was solved for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import FloatArray
from ..errors import CertificateError, ReachError
from ..tissue.compliance import CondensedSection
from .faces import displacement, touch
from .formulation import OPEN, ContactProblem, ContactState, shearing_and_pressing, unloaded
from .ownership import given_as, nearest_now, overlapped
from .profile import profile

# distance of two nodes over the skin that belongs to them [1]; source: of equal elements 1/2 if they share one, 2/3 at
# the end of a face, at least 1 if there is another between
ADJACENT = 0.75

# What a certificate may not exceed; source: each lies over an order below the error of a strain score that is aimed at
# (0.5 %); of the change of strain see docs/model.md, section 8
PENETRATION_LIMIT = 1e-4  # of the indentation [1]
TENSION_LIMIT = 1e-6  # of the largest pressure [1]
CONE_LIMIT = 1e-6  # of the largest shear that friction allows, without friction of the largest pressing force [1]
# of the work of friction under the largest force so far along the indentation [1]; source: slip is solved to 1e-9 of
# the way, in up to a hundred increments
DISSIPATION_LIMIT = 1e-7

LEAST = ("smallest_pressure", "dissipation")  # figures of a certificate that are worst where they are smallest


@dataclass(frozen=True)
class Certificate:
    """What a solution found when it checked itself: the worst of all its states.

    equilibrium: relative residual of the tissue's equilibrium [1]. contact: of the contact equations [1].
    penetration: largest [mm]. smallest_pressure: over the nodes in contact [MPa]. cone_excess: largest shear beyond
    Coulomb's limit, over the largest limit, or without friction over the largest pressing force [1]. dissipation:
    smallest frictional work so far [N mm per mm]. penetration_share, gap_share, tension_share, cone_share: of what was
    allowed there [1], of penetration, a gap in contact, tension and excess over the friction cone.
    """

    equilibrium: float
    contact: float
    penetration: float
    smallest_pressure: float
    cone_excess: float
    dissipation: float
    penetration_share: float
    gap_share: float
    tension_share: float
    cone_share: float


def certify(problem: ContactProblem, section: CondensedSection, state: ContactState) -> Certificate:
    """Check a state against the laws it was solved for. Raises CertificateError, with the figures, beyond a limit, and
    ReachError if contact comes to the last node considered.
    """
    active = state.status != OPEN
    shearing, pressing = shearing_and_pressing(problem, [state])[0].T
    pressure = pressing / section.weight
    largest = float(pressure.max(initial=0.0))
    excess = np.abs(shearing) - problem.friction * pressing
    gap = reevaluated_gap(problem, state)
    penetration = max(float(-gap.min()), 0.0)
    separation = float(gap[active].max(initial=0.0))
    smallest = float(pressure[active].min()) if active.any() else 0.0
    indentation = float(np.abs(state.actuator).max())
    # what lies within the tolerance of gaps may just touch, and rounding may pull
    slight = problem.tolerance * indentation / float(np.diag(problem.compliance).max())
    limit = (problem.friction or 1.0) * max(float(pressing.max()), slight)
    beyond = max(float(excess.max()), 0.0) / limit if limit > 0.0 else 0.0
    work = problem.friction * max(state.largest_force, slight) * indentation
    checks = {
        "contact residual": (state.residual, problem.tolerance),
        "penetration [mm]": (penetration, PENETRATION_LIMIT * indentation),
        "gap in contact [mm]": (separation, PENETRATION_LIMIT * indentation),
        "tension [MPa]": (-smallest, max(TENSION_LIMIT * largest, slight / float(section.weight.max()))),
        "excess over the friction cone": (beyond, CONE_LIMIT),
        "negative dissipation [N mm/mm]": (-state.dissipation, DISSIPATION_LIMIT * work),
    }
    for name, (found, allowed) in checks.items():
        if not found <= allowed:
            raise CertificateError(f"certificate: {name} {found:.2e} > {allowed:.2e}")
    require_within_reach(problem, section, state)
    share = {name: found / allowed if found > 0.0 else 0.0 for name, (found, allowed) in checks.items()}
    return Certificate(
        equilibrium=section.residual,
        contact=state.residual,
        penetration=penetration,
        smallest_pressure=smallest,
        cone_excess=beyond,
        dissipation=state.dissipation,
        penetration_share=share["penetration [mm]"],
        gap_share=share["gap in contact [mm]"],
        tension_share=share["tension [MPa]"],
        cone_share=share["excess over the friction cone"],
    )


def worst(certificates: Sequence[Certificate]) -> Certificate:
    """The worst figures of several states."""
    figures = {
        field.name: (min if field.name in LEAST else max)(getattr(each, field.name) for each in certificates)
        for field in fields(Certificate)
    }
    return Certificate(**figures)


def require_within_reach(problem: ContactProblem, section: CondensedSection, state: ContactState) -> None:
    """Raise ReachError if an actuator touches, or overlaps by more than PENETRATION_LIMIT, skin that was not considered
    to be its own.

    Contact may reach an actuator's last node where the next node of the skin is a neighbour's; but no node may press
    into another actuator than the one it was given to.
    """
    own, x = state.given, problem.position[:, 0]
    allowed = PENETRATION_LIMIT * float(np.abs(state.actuator).max())
    active = state.status != OPEN
    adjacent = np.diff(x) <= ADJACENT * (section.weight[1:] + section.weight[:-1])
    reached = active & (np.append(True, ~adjacent) | np.append(~adjacent, True))  # first or last nodes side by side
    beyond = np.flatnonzero(reached | overlapped(problem, state, allowed))
    if beyond.size:
        node = beyond[0]
        aside = abs(state.place[node] + problem.row.positions[own[node]] + state.actuator[own[node], 0] - x[node])
        moved = bool(np.any(state.actuator != [0.0, state.actuator[0, 1]]))  # pre-indentation raises all alike
        less = "; shorter strokes, or a row that is pressed less deep, move it less" if moved else ""
        centre = problem.row.positions[own[node]]
        if reached[node]:
            reaches = f"at the actuator at x = {centre:g} mm reaches the edge of the modelled contact zone"
            advice = f"{less}; a larger numerics.contact_margin considers more skin"
        else:
            neighbour = problem.row.positions[nearest_now(problem, state)[node]]
            reaches = f"at the actuator at x = {neighbour:g} mm reaches skin that only its neighbour's may touch"
            advice = less
        raise ReachError(f"certificate: contact {reaches}; skin there has moved {aside:.2g} mm sideways{advice}")


def reevaluated_gap(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Gaps (n,) [mm] computed again from a state's forces, with the actuators' compliance where the skin now is."""
    problem = given_as(problem, state)
    there = touch(problem, state.place)
    x, y = (unloaded(problem, state.actuator) + displacement(problem, state.force, there)).T
    return y + profile(problem.row, x)[0]
