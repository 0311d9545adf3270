"""Time set-up and solution of every device in one process, each step repeated, and write medians and spreads."""

import statistics
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from fingerpad.benchmark.timing import peak_memory, timed
from fingerpad.contact_law import Interface
from fingerpad.device import Condition
from fingerpad.edges import edge_intervals
from fingerpad.mesh import SectionMesh, mesh_section
from fingerpad.prediction import Condensed, Meshed, prepared, pressed_device, read_out
from fingerpad.reach import contact_tractions
from fingerpad.roughness import score_rows
from fingerpad.scene import Scene
from fingerpad.scenefile import load_scene
from fingerpad.solution import Solution
from fingerpad.store import write_rows
from fingerpad.tissue_law import Kinematics


def steps_of(scene: Scene, repeats: int) -> tuple[SectionMesh, dict[str, list[float]]]:
    """The mesh, and seconds of every step: set-up, and the whole path of the last condition."""
    edges, edge_seconds = timed(repeats, partial(edge_intervals, scene))
    section, mesh_seconds = timed(repeats, partial(mesh_section, scene, edges))
    condensed, prepare_seconds = timed(repeats, partial(prepared, scene, edges))
    steps = {"edges": edge_seconds, "mesh": mesh_seconds}
    if scene.kinematics is Kinematics.SMALL:
        steps["mesh and condense"] = prepare_seconds
    steps["set-up"] = [sum(seconds) for seconds in zip(edge_seconds, prepare_seconds, strict=True)]
    for interface in scene.device.interfaces():
        solve, indent_seconds = timed(repeats, partial(pressed_device, scene, condensed, interface))
        stimulating = partial(from_stimulus_to_score, scene, condensed, interface, solve)
        _, stimulus_seconds = timed(repeats, stimulating)
        steps[f"pre-indentation, {interface}"] = indent_seconds
        steps[f"stimulus to score, {interface}"] = stimulus_seconds
        whole = [sum(seconds) for seconds in zip(indent_seconds, stimulus_seconds, strict=True)]
        steps[f"condition, {interface}"] = whole
    return section, steps


def from_stimulus_to_score(
    scene: Scene, condensed: Condensed | Meshed, interface: Interface, solve: Callable[[Condition], Solution]
) -> None:
    """The last condition on the pressed finger: stimulus, certificate, read-outs, scores."""
    condition = scene.device.conditions[-1]
    score_rows(scene, condition, interface, read_out(scene, condensed, solve(condition)))


def main(config: Path, devices: list[Path], finite: list[Path], repeats: dict[str, int], timings: Path) -> None:
    """Read the scenes, those of `finite` with finite kinematics too, time them, write one row a step."""
    rows: list[dict[str, Any]] = []
    scenes = [load_scene(config, path) for path in devices]
    scenes += [load_scene(config, path, Kinematics.FINITE) for path in finite]
    for scene in scenes:
        section, steps = steps_of(scene, repeats[scene.kinematics])
        for step, seconds in steps.items():
            rows.append(
                {
                    "kinematics": str(scene.kinematics),
                    "device": scene.device.name,
                    "step": step,
                    "unknowns": section.unknowns,
                    "contact_nodes": contact_tractions(section, scene).weight.size,
                    "n": repeats[scene.kinematics],
                    "median_s": round(statistics.median(seconds), 4),
                    "lowest_s": round(min(seconds), 4),
                    "highest_s": round(max(seconds), 4),
                    "peak_MiB_so_far": round(peak_memory()),
                }
            )
    write_rows(timings, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        [Path(path) for path in job.input.devices],
        [Path(path) for path in job.input.finite],
        job.params.repeats,
        Path(job.output.timings),
    )
