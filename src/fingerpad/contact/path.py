"""A path of contact: increments in a straight line, halved where they do not converge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np

from ..arrays import FloatArray
from ..errors import ContactError
from .formulation import ContactProblem, ContactState
from .increment import solve_increment
from .not_converged import NotConvergedError
from .patch import Patch


class PathState(Protocol):
    """What a path asks of a state, a dataclass: where the actuators stand, and increments halved so far."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def actuator(self) -> FloatArray: ...
    @property
    def cuts(self) -> int: ...


State = TypeVar("State", bound=PathState)
Carried = TypeVar("Carried")  # what an increment leaves to use again, as a patch; or None

NEGLIGIBLE = 1e-12  # relative movement [1] that is none; source: halved 10 times it is rounding
# Distances of the closest nodes [1] to which increments grow again once one was halved, as fronts that cross many nodes
# at once fail again and again; source: fewest seconds of 1, 2, 4 (a stroke of 1 mm of six close pins, measured)
CROSSED = 2.0
# Times as many halvings [1] in a straight line as one increment may have; a path that needs more is lost. source:
# chosen, as a bound on time
CRAWL = 2
# Iterations [1] of an increment with which the path ends if it fails, in place of MAX_ITERATIONS; source: of 106 random
# scenes that did not converge 5 are solved so, and in 39 states turn out to be turned (half a second each, measured)
LAST_ITERATIONS = 600


class SolveIncrement(Protocol[State, Carried]):
    """Solves one increment: from a problem, a state, where the actuators go, and what the last increment left to use
    again. Raises NotConvergedError.
    """

    def __call__(
        self, problem: ContactProblem, start: State, actuator: FloatArray, carried: Carried, /
    ) -> tuple[State, Carried]: ...


def follow(problem: ContactProblem, state: ContactState, target: FloatArray, increments: int) -> ContactState:
    """Move the actuators in a straight line to `target` (n_actuators, 2) [mm] in equal increments, cut where needed.

    Raises ConvergenceError if an increment does not converge after problem.max_cuts halvings, or the whole line takes
    CRAWL times as many, the last of them with LAST_ITERATIONS; UniquenessError if states that were tried on the last
    one are turned (see `active_set`); ReachError if skin touches two actuators at once.
    """
    return advance(problem, state, target, increments, None, solve_increment)[0]


def advance(
    problem: ContactProblem,
    state: State,
    target: FloatArray,
    increments: int,
    carried: Carried,
    solve: SolveIncrement[State, Carried],
    drifting: bool = False,
) -> tuple[State, Carried]:
    """`follow` with a given way to solve an increment. carried: what an earlier increment has left to be used again, or
    nothing; that of the last increment is returned. Where the actuators stand there is nothing to solve, unless nodes
    are `drifting`.

    Raises as `follow`; on tissue that deforms much InvertedError or SnapError, if that is why.
    """
    start = state.actuator
    standing = stands(start, target)
    if standing and not drifting:
        return state, carried
    target = start if standing else target
    done, step = 0.0, 1.0  # in increments
    ways = np.abs(target - start).max(axis=1)
    length, moved = float(ways.max()), int(ways.argmax())
    smallest = 2.0 ** (0 if standing else -problem.max_cuts)  # where nothing moves, half of it is as hard
    cuts, longest = 0, step
    patient = replace(problem, most_iterations=LAST_ITERATIONS)
    while done < increments:
        goal = increments if done + step > increments - smallest / 2.0 else done + step
        last = goal - done < 2.0 * smallest or cuts >= CRAWL * problem.max_cuts
        try:
            place = target if goal == increments else start + goal / increments * (target - start)
            state, carried = solve(patient if last and not standing else problem, state, place, carried)
            done = goal
            step = min(2.0 * step, longest)
        except NotConvergedError as failure:
            step = (goal - done) / 2.0
            cuts += 1
            state = replace(state, cuts=state.cuts + 1)
            if last:
                halved = f" halved {round(-np.log2(goal - done))} times" if step < smallest else f", {cuts} halvings"
                where = (
                    f"{done / increments:.1%} of the way from {_located(start[moved])} to"
                    f" {_located(target[moved])} mm, increment {int(done) + 1}/{increments}{halved}"
                )
                raise _lost(problem, failure, where) from failure
            longest = min(longest, max(step, CROSSED * problem.spacing * increments / length))
    return state, carried


def recording(solve: SolveIncrement[State, Carried], note: Callable[[State], object]) -> SolveIncrement[State, Carried]:
    """An increment's solver that shows every state it finds."""

    def solve_and_note(
        problem: ContactProblem, start: State, actuator: FloatArray, carried: Carried
    ) -> tuple[State, Carried]:
        state, left = solve(problem, start, actuator, carried)
        note(state)
        return state, left

    return solve_and_note


def drifting_to(
    last: FloatArray,
    begin: FloatArray,
    target: FloatArray,
    power: int = 1,
    patches: dict[float, Patch] | None = None,
) -> SolveIncrement[ContactState, Patch | None]:
    """What solves an increment of a line from `begin` to `target` (n_actuators, 2) [mm] along which contact nodes
    without forces drift from the problem's place to `last` (n, 2) [mm], with a power of the way.

    patches: by the share of the way [1], that such a line with another drift left; those of this one are put there.
    """
    length = float(np.abs(target - begin).max())
    kept = {} if patches is None else patches

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, patch: Patch | None
    ) -> tuple[ContactState, Patch]:
        first = np.zeros_like(last) if problem.free is None else problem.free
        way = 1.0 if stands(begin, target) else float(np.abs(actuator - begin).max()) / length
        there = replace(problem, free=first + way**power * (last - first))
        state, kept[way] = solve_increment(there, state, actuator, kept.get(way, patch))
        return state, kept[way]

    return solve


def stands(begin: FloatArray, target: FloatArray) -> bool:
    """Whether the way from `begin` to `target` (n_actuators, 2) [mm] is none."""
    return bool(np.abs(target - begin).max() <= NEGLIGIBLE * max(np.abs(begin).max(), np.abs(target).max()))


def _lost(problem: ContactProblem, failure: NotConvergedError, where: str) -> ContactError:
    """The error that ends a path where an increment did not converge."""
    missed = problem.tolerance < failure.residual < np.inf
    residual = f", residual {failure.residual:.1e}, tolerance {problem.tolerance:.0e}" if missed else ""
    other = "stiffer bodies" if problem.body else "a finer mesh at the edges (numerics.edge_size)"
    return type(failure.reason)(f"contact did not converge {where}{residual}; {failure.reason} or {other}")


def _located(actuator: FloatArray) -> str:
    """Where an actuator (2,) stands, in few words."""
    return f"({actuator[0]:.4g}, {actuator[1]:.4g})"
