"""Recover the full fields of every stimulus of a device, with friction."""

from pathlib import Path

import numpy as np

from fingerpad.mesh import load_section
from fingerpad.recovery import recover_fields
from fingerpad.scenefile import load_scene
from fingerpad.solution import Solution
from fingerpad.store import load, save


def main(config: Path, device: Path, mesh: Path, solutions: list[Path], fields: Path) -> None:
    """Read the last contact forces of every solution, recover the fields, write them in the same order."""
    forces = np.array([load(path, Solution).force[-1] for path in solutions])
    save(fields, recover_fields(load_section(mesh), load_scene(config, device), forces))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.mesh),
        [Path(path) for path in job.input.solutions],
        Path(job.output.fields),
    )
