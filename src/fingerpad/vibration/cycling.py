"""Vibration of a pressed device on tissue that creeps, until cycles repeat themselves.

Pre-indentation has been held until tissue was relaxed, with contact forces f0. From there the tissue answers forces
f = f0 + F that change with time by (see `creep`)
    u = C f0 + C_g F + sum of C_k w_k,        t_k dw_k/dt = F - w_k,
and receptors likewise. Over a step h in which F changes evenly this is exact:
    w_k' = a w_k + (1 - a) F + b (F' - F),        a = exp(-h / t_k),        b = 1 - (1 - a) t_k / h,
so that at its end u' = C_h f' + free with the compliance C_h = C_g + sum of b C_k: contact as on any tissue. Slow terms
would take hundreds of cycles to settle; each cycle begins with the w_k that its forces would leave for ever.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import ContactProblem, ContactState
from ..contact.linear_solution import Indented
from ..contact.patch import Patch
from ..contact.path import advance, drifting_to
from ..errors import CycleError
from ..scene.device import CROSSING, Cycle
from ..tissue.compliance import CondensedSection, displaced
from .creep import Creep
from .speed import SLOWLY, frequency_name

MAX_CYCLES = 60  # [1] before it is given up; source: usual count is 3-10 (measured)
REPEATED = 5e-4  # change of what is read at the receptors from cycle to cycle [1]; source: a tenth of the score error
# that is aimed at (0.5 %). Friction may let the skin walk on by less than that, which is not followed
NOISE = 1e-8  # of strain [1], below which its change is rounding; source: ten tolerances of the contact solver


@dataclass(frozen=True)
class Stepping:
    """Steps of one length. fading: a, following: b of each term, (k, 1, 1) [1]. problem: of contact, with C_h."""

    fading: FloatArray
    following: FloatArray
    problem: ContactProblem


@dataclass(frozen=True)
class Moment:
    """Where a step ends. state: of contact. memory: w (k, n, 2) [N/mm]. free: (n, 2) displacement of contact nodes that
    forces before have left, C_h f apart [mm]. patch: that contact was solved on.
    """

    state: ContactState
    memory: FloatArray
    free: FloatArray
    patch: Patch | None


@dataclass(frozen=True)
class Vibration:
    """The last cycle of a vibration.

    problems, states: of contact at the ends of its steps, the last at phase 0. skin: (n_times, n, 2) displacement of
    contact nodes then [mm]. strain: (n_times, 3m) at the receptors then [1].
    """

    problems: list[ContactProblem]
    states: list[ContactState]
    skin: FloatArray
    strain: FloatArray


def vibrate(indented: Indented, creep: Creep, cycle: Cycle, frequency: float, steps: int) -> Vibration:
    """Vibrate a pressed device at a frequency [Hz], or SLOWLY, on tissue that is always relaxed.

    indented: on relaxed tissue. steps: a cycle is followed in. The first cycle grows evenly from rest. Raises
    ConvergenceError, UniquenessError, and CycleError if cycles do not come to repeat themselves.
    """
    problem, before = indented.problem, indented.state
    is_slow = frequency <= SLOWLY
    stepping = _stepping(problem, creep, np.inf if is_slow else 1.0 / (frequency * steps))
    phases = 2.0 * np.pi * np.arange(1, steps + 1) / steps
    nothing = np.zeros((creep.time.size, *before.force.shape))
    moment = Moment(before, nothing, _left(stepping, creep, before, nothing), None)
    # forces answer what has crept: as much as they would if all of the tissue crept alike
    share = np.trace(creep.compliance, axis1=1, axis2=2) / np.trace(problem.compliance)
    watched = [np.zeros(1)]
    for number in range(MAX_CYCLES):
        memory, moments = moment.memory, []
        for phase in phases:
            growth = phase / (2.0 * np.pi) if number == 0 else 1.0
            target = before.actuator + growth * displacement(cycle, phase)
            moment = _stepped(stepping, creep, before, moment, target)
            moments.append(moment)
        strain = _strain(indented.section, creep, before, moments)
        then, watched = watched, [strain[-1], strain[-1] - strain.mean(axis=0)]
        noise = NOISE * float(np.linalg.norm(strain[-1]))
        if number > 1 and all(_repeated(*each, noise) for each in zip(watched, then, strict=True)):
            problems = [replace(stepping.problem, free=each.free) for each in moments]
            moves = [displaced(stepping.problem.compliance, each.state.force) for each in moments]
            skin = np.array([each.free + moved for each, moved in zip(moments, moves, strict=True)])
            return Vibration(problems, [each.state for each in moments], skin, strain)
        if number > 0:  # the first cycle is another than all that follow
            left = stepping.fading**steps
            for_ever = (moment.memory - left * memory) / (1.0 - left)
            # forces answer what creeps and drive it back: by as much as if all tissue crept alike
            answered = np.tensordot(share, for_ever - moment.memory, 1)
            moment = replace(moment, memory=for_ever - answered)
    rubbing = "friction ratchets the skin" if problem.friction > 0.0 else ""
    creeping = "" if is_slow else "tissue still creeps"
    why = ", or ".join(filter(None, [rubbing, creeping])) or "contact does not repeat itself"
    where = "without creep" if is_slow else f"at {frequency_name(frequency)}"
    advice = "; try a smaller amplitude" if rubbing else ""
    raise CycleError(f"no periodic state after {MAX_CYCLES} cycles {where}: {why}{advice}")


def _repeated(now: FloatArray, then: FloatArray, noise: float) -> bool:
    """Whether what is read in a cycle is what was read in the one before."""
    return bool(np.linalg.norm(now - then) <= REPEATED * np.linalg.norm(now) + noise)


def displacement(cycle: Cycle, phase: float) -> FloatArray:
    """Displacement (n_actuators, 2) [mm] at a phase [rad] of the cycle."""
    turned = np.exp(1j * phase) * np.stack([cycle.tangential, cycle.normal], axis=1)
    return np.round(turned.real, CROSSING)


def _stepping(problem: ContactProblem, creep: Creep, step: float) -> Stepping:
    """Steps of that length [s], infinite for tissue that is always relaxed."""
    if np.isinf(step):
        fading, following = np.zeros(creep.time.size), np.ones(creep.time.size)
    else:
        fading = np.exp(-step / creep.time)
        following = 1.0 - (1.0 - fading) * creep.time / step
    compliance = problem.compliance - np.tensordot(1.0 - following, creep.compliance, 1)
    return Stepping(fading[:, None, None], following[:, None, None], replace(problem, compliance=compliance))


def _stepped(stepping: Stepping, creep: Creep, before: ContactState, start: Moment, target: FloatArray) -> Moment:
    """A step with the actuators to `target` (n_actuators, 2) [mm]."""
    fading, following = stepping.fading, stepping.following
    added = start.state.force - before.force
    kept = fading * start.memory + (1.0 - fading - following) * added
    last = _left(stepping, creep, before, kept)
    drifting = replace(stepping.problem, free=start.free)
    solve = drifting_to(last, start.state.actuator, target)
    state, patch = advance(drifting, start.state, target, 1, start.patch, solve, drifting=True)
    return Moment(state, kept + following * (state.force - before.force), last, patch)


def _left(stepping: Stepping, creep: Creep, before: ContactState, kept: FloatArray) -> FloatArray:
    """Displacement (n, 2) [mm] of contact nodes besides C_h f, from what is kept of w (k, n, 2) [N/mm]."""
    forces = kept + (1.0 - stepping.following) * before.force
    return np.matmul(creep.compliance, forces.reshape(*creep.time.shape, -1, 1)).sum(axis=0).reshape(-1, 2)


def _strain(section: CondensedSection, creep: Creep, before: ContactState, moments: Sequence[Moment]) -> FloatArray:
    """Strain (n_times, 3m) [1] at the receptors: that of relaxed tissue, less what has not crept yet."""
    forces = np.array([each.state.force for each in moments])
    left = np.array([each.state.force - before.force - each.memory for each in moments])
    crept = np.matmul(creep.strain, left.reshape(*left.shape[:2], -1).transpose(1, 2, 0)).sum(axis=0)
    return section.receptor_strain(forces) - crept.T
