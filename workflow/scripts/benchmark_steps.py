"""Time set-up and solution of every device in one process, each step repeated, and write medians and spreads."""

import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fingerpad.condensation import condense_body, condense_section
from fingerpad.edges import mesh_device
from fingerpad.gabor import filtered_readouts
from fingerpad.resampling import resampling_to_grid
from fingerpad.roughness import score_rows
from fingerpad.scene import Interface
from fingerpad.scenefile import load_scene
from fingerpad.solution import Solution, solve_condition
from fingerpad.store import write_rows

MEBIBYTE = 1024.0  # KiB in one; the system counts peak memory in KiB


def timed(repeats: int, work: Callable[[], Any]) -> tuple[Any, list[float]]:
    """What the work returns, and the seconds of each repetition."""
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - start)
    return result, seconds


def main(config: Path, devices: list[Path], repeats: int, timings: Path) -> None:
    """Read the scenes, time mesh, condensation and the whole path of the last condition, write one row a step."""
    rows: list[dict[str, Any]] = []
    for path in devices:
        scene = load_scene(config, path)
        section, mesh_seconds = timed(repeats, lambda scene=scene: mesh_device(scene))
        condensed, condense_seconds = timed(
            repeats, lambda section=section, scene=scene: condense_section(section, scene)
        )
        resampling, resample_seconds = timed(
            repeats, lambda arc=condensed.arc, scene=scene: resampling_to_grid(arc, scene.model.gabor.spacing)
        )
        body = condense_body(scene) if scene.device.actuators.body else None
        steps = {"mesh": mesh_seconds, "condense": condense_seconds, "resample": resample_seconds}
        steps["set-up"] = [sum(seconds) for seconds in zip(*steps.values(), strict=True)]
        for interface in scene.device.interfaces():

            def whole_path(interface: Interface = interface) -> Solution:
                condition = scene.device.conditions[-1]  # noqa: B023
                solution = solve_condition(scene, condensed, body, condition, interface)  # noqa: B023
                read = filtered_readouts(
                    resampling,  # noqa: B023
                    solution.strain,
                    solution.change_of_strain,
                    scene.model.gabor,  # noqa: B023
                )
                score_rows(scene, condition, interface, read)  # noqa: B023
                return solution

            _, steps[f"condition, {interface}"] = timed(repeats, whole_path)
        for step, seconds in steps.items():
            rows.append(
                {
                    "device": scene.device.name,
                    "step": step,
                    "unknowns": 2 * section.mesh.doflocs.shape[1],
                    "contact_nodes": condensed.position.shape[0],
                    "n": repeats,
                    "median_s": round(statistics.median(seconds), 4),
                    "lowest_s": round(min(seconds), 4),
                    "highest_s": round(max(seconds), 4),
                    "peak_MiB_so_far": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEBIBYTE),
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
