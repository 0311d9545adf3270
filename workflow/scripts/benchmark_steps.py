"""Time set-up and solution of every device in one process, each step repeated, and write medians and spreads."""

import statistics
from functools import partial
from pathlib import Path
from typing import Any

from fingerpad.benchmark.timing import peak_memory, timed
from fingerpad.edges import edge_intervals
from fingerpad.mesh import mesh_section
from fingerpad.prediction import Condensed, condense_scene, read_out
from fingerpad.roughness import score_rows
from fingerpad.scene import Scene
from fingerpad.scenefile import load_scene
from fingerpad.solution import Indented, indent_device, stimulate
from fingerpad.store import write_rows


def from_stimulus_to_score(scene: Scene, condensed: Condensed, indented: Indented) -> None:
    """The last condition on the pressed finger: stimulus, certificate, read-outs, scores."""
    condition = scene.device.conditions[-1]
    read = read_out(scene, condensed, stimulate(scene, condensed.section, indented, condition))
    score_rows(scene, condition, indented.interface, read)


def main(config: Path, devices: list[Path], repeats: int, timings: Path) -> None:
    """Read the scenes, time set-up and the whole path of the last condition, write one row a step."""
    rows: list[dict[str, Any]] = []
    for path in devices:
        scene = load_scene(config, path)
        edges, edge_seconds = timed(repeats, lambda scene=scene: edge_intervals(scene))
        section, mesh_seconds = timed(repeats, lambda scene=scene, edges=edges: mesh_section(scene, edges))
        condensed, condense_seconds = timed(repeats, lambda scene=scene, edges=edges: condense_scene(scene, edges))
        steps = {"edges": edge_seconds, "mesh": mesh_seconds, "mesh and condense": condense_seconds}
        steps["set-up"] = [sum(seconds) for seconds in zip(edge_seconds, condense_seconds, strict=True)]
        for interface in scene.device.interfaces():
            indenting = partial(indent_device, scene, condensed.section, condensed.body, interface)
            indented, indent_seconds = timed(repeats, indenting)
            _, stimulus_seconds = timed(repeats, partial(from_stimulus_to_score, scene, condensed, indented))
            steps[f"pre-indentation, {interface}"] = indent_seconds
            steps[f"stimulus to score, {interface}"] = stimulus_seconds
            whole = [sum(seconds) for seconds in zip(indent_seconds, stimulus_seconds, strict=True)]
            steps[f"condition, {interface}"] = whole
        for step, seconds in steps.items():
            rows.append(
                {
                    "device": scene.device.name,
                    "step": step,
                    "unknowns": 2 * section.mesh.doflocs.shape[1],
                    "contact_nodes": condensed.section.position.shape[0],
                    "n": repeats,
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
        job.params.repeats,
        Path(job.output.timings),
    )
