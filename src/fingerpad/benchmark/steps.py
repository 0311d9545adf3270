"""Seconds of every step from scene to score, in one process."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from functools import partial
from typing import Any

from ..contact.solution import Solution
from ..prediction.edges import edge_intervals
from ..prediction.scoring import Condensed, Meshed, prepared, pressed_device, read_out
from ..readouts.roughness import score_rows
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.mesh import SectionMesh, mesh_section
from ..tissue.reach import contact_tractions
from .timing import peak_memory, timed


def step_rows(scene: Scene, repeats: int) -> list[dict[str, Any]]:
    """A row for every step of a device, repeated so often: set-up, and the whole path of the last condition. Raises
    what the steps raise.
    """
    section, steps = _steps_of(scene, repeats)
    return [
        {
            "kinematics": str(scene.kinematics),
            "device": scene.device.name,
            "step": step,
            "unknowns": section.unknowns,
            "contact_nodes": contact_tractions(section, scene).weight.size,
            "n": repeats,
            "median_s": round(statistics.median(seconds), 4),
            "lowest_s": round(min(seconds), 4),
            "highest_s": round(max(seconds), 4),
            "peak_MiB_so_far": round(peak_memory()),
        }
        for step, seconds in steps.items()
    ]


def _steps_of(scene: Scene, repeats: int) -> tuple[SectionMesh, dict[str, list[float]]]:
    """The mesh, and seconds of every step."""
    edges, edge_seconds = timed(repeats, partial(edge_intervals, scene))
    section, mesh_seconds = timed(repeats, partial(mesh_section, scene, edges))
    condensed, prepare_seconds = timed(repeats, partial(prepared, scene, edges))
    steps = {"edges": edge_seconds, "mesh": mesh_seconds}
    if scene.kinematics is Kinematics.SMALL:
        steps["mesh and condense"] = prepare_seconds
    steps["set-up"] = _both(edge_seconds, prepare_seconds)
    for interface in scene.device.interfaces():
        solve, indent_seconds = timed(repeats, partial(pressed_device, scene, condensed, interface))
        _, stimulus_seconds = timed(repeats, partial(_from_stimulus_to_score, scene, condensed, interface, solve))
        steps[f"pre-indentation, {interface}"] = indent_seconds
        steps[f"stimulus to score, {interface}"] = stimulus_seconds
        steps[f"condition, {interface}"] = _both(indent_seconds, stimulus_seconds)
    return section, steps


def _from_stimulus_to_score(
    scene: Scene, condensed: Condensed | Meshed, interface: Interface, solve: Callable[[Condition], Solution]
) -> None:
    """The last condition on the pressed finger: stimulus, certificate, read-outs, scores."""
    condition = scene.device.conditions[-1]
    score_rows(scene, condition, interface, read_out(scene, condensed, solve(condition)))


def _both(first: list[float], second: list[float]) -> list[float]:
    """Seconds of two steps in a row, repetition by repetition."""
    return [sum(seconds) for seconds in zip(first, second, strict=True)]
