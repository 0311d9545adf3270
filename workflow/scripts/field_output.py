"""Write the full fields of one device, condition and interface as VTU files and their path in time as a PVD file."""

from pathlib import Path

import numpy as np

from fingerpad.mesh import load_section
from fingerpad.scenefile import load_scene
from fingerpad.solution import Solution
from fingerpad.store import load
from fingerpad.vtu import field_meshes, write_collection, write_vtu


def main(
    config: Path, device: Path, mesh: Path, solution: Path, condition: str, vtu: Path, pvd: Path, states: Path
) -> None:
    """Read mesh and contact forces, recover the fields of all states, write the last and, in a folder, those before."""
    scene, solved = load_scene(config, device), load(solution, Solution)
    forces = np.stack([solved.indented_force, *solved.force])
    *before, last = field_meshes(load_section(mesh), scene, forces)
    states.mkdir(parents=True, exist_ok=True)
    files = [states / f"{number:04d}.vtu" for number in range(len(before))]
    for file, state in zip([*files, vtu], [*before, last], strict=True):
        write_vtu(file, state)
    write_collection(pvd, [0.0, *scene.device.condition(condition).time], [*files, vtu])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.mesh),
        Path(job.input.solution),
        job.wildcards.condition,
        Path(job.output.vtu),
        Path(job.output.pvd),
        Path(job.output.states),
    )
