"""Forces that actuators have to bear: of every actuator, after pre-indentation and at the times of every condition."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from ..arrays import FloatArray
from ..contact.solution import Solution
from ..errors import UnsolvedError
from ..readouts.accuracy import COARSENING, DIFFERENCE
from ..readouts.roughness import NO_PREDICTION
from ..scene.scene import Scene
from .caveats import caveats_of
from .edges import edge_intervals
from .scoring import UNKNOWN, Case, Solved, attempt, prepared, solve_scene

NORMAL, TANGENTIAL, ERROR = "normal_N_per_mm", "tangential_N_per_mm", "error_N_per_mm"  # columns


def force_rows(scene: Scene, error: bool = True, step: Callable[[], object] = lambda: None) -> list[dict[str, Any]]:
    """Forces with which every actuator acts on the skin, at every time of every condition that the device is predicted
    in: `kinematics, device, condition, interface, time, time_unit, is_read, actuator` (from 1, at the left), `x_mm` (of
    the row before it moves); per mm of finger `normal_N_per_mm` (into the skin), `tangential_N_per_mm` (to the right)
    and `error_N_per_mm`, the estimated discretisation error of either; `note`; `caveats`, a tuple of sentences.

    The first time of a condition is that of pre-indentation; `is_read` marks the one at which it is scored. What cannot
    be solved has one row, without a time, and a note that says why. error: whether to solve once more, more coarsely;
    without, or if that cannot be done, as the note then says, errors are None. step: called after each of `steps`.

    The error of a force F is |F_2 - F| / DIFFERENCE, with F_2 that of the coarser solution. As a difference may vanish
    by chance, the largest of all actuators and both directions at a time is taken, for all of them.
    """
    with threadpool_limits(1):  # two threads take longer (decision 14), and results depend on their number
        edges = edge_intervals(scene)
        solved = list(_solved(scene, edges, step))
        coarser = {each.case: each for each in _solved(scene.coarsened(COARSENING), edges, step)} if error else {}
    return [row for each in solved for row in _rows(scene, each, coarser)]


def _solved(scene: Scene, edges: FloatArray, step: Callable[[], object]) -> Iterator[Solved]:
    """All conditions at all interfaces, solved on a mesh with edges (k, 2) [mm] as far as they can be."""
    condensed = attempt(prepared, scene, edges)
    step()
    for each in solve_scene(scene, condensed):
        yield each
        step()


def _rows(scene: Scene, solved: Solved, coarser: Mapping[Case, Solved]) -> Iterator[dict[str, Any]]:
    """Rows of one case."""
    condition, found = solved.condition, solved.solution
    where = {
        "kinematics": str(scene.kinematics),
        "device": scene.device.name,
        "condition": condition.name,
        "interface": str(solved.interface),
    }
    if isinstance(found, UnsolvedError):
        nothing = dict.fromkeys(("time", "time_unit", "is_read", "actuator", "x_mm", NORMAL, TANGENTIAL, ERROR))
        note = f"{NO_PREDICTION}: {found}"
        yield where | nothing | {"note": note, "caveats": (note,)}
        return
    errors, note = _errors(found, coarser.get(solved.case))
    caveats = (*caveats_of(scene, condition, found, solved.interface), *([note] if note else []))
    for number, time in enumerate(condition.times):
        at = {"time": float(time), "time_unit": condition.time_unit, "is_read": number == 1 + found.reading.time}
        for actuator, x in enumerate(scene.device.actuators.positions):
            tangential, normal = found.actuator_force[number, actuator].tolist()
            own = {"actuator": 1 + actuator, "x_mm": x, NORMAL: normal, TANGENTIAL: tangential}
            yield where | at | own | {ERROR: errors[number], "note": note, "caveats": caveats}


def _errors(found: Solution, coarser: Solved | None) -> tuple[list[float | None], str]:
    """The error [N/mm] at every time, from the coarser solution, and a note where there is none."""
    unknown: list[float | None] = [None] * len(found.actuator_force)
    if coarser is None:
        return unknown, ""
    if isinstance(coarser.solution, UnsolvedError):
        return unknown, f"{UNKNOWN}{coarser.solution}"
    off = np.abs(coarser.solution.actuator_force - found.actuator_force).max(axis=(1, 2)) / DIFFERENCE
    return off.tolist(), ""
