"""Errors of one device's scores, from a solution on a coarser mesh with larger load increments."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import logged
from fingerpad.prediction.edges import load_edges
from fingerpad.prediction.scoring import ReadSolution, error_rows
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, write_rows


def main(
    config: Path,
    device: Path,
    kinematics: str,
    edges: Path,
    cases: list[tuple[str, str]],
    solutions: list[Path],
    filtered: list[Path],
    errors: Path,
) -> None:
    """Read the scene, its edges and what was read in all cases, solve them coarsely, write errors."""
    scene = load_scene(config, device, Kinematics(kinematics))
    read = {
        (condition, Interface(interface)): ReadSolution(load(solved, Solution), load(path, FilteredReadouts))
        for (condition, interface), solved, path in zip(cases, solutions, filtered, strict=True)
    }
    write_rows(errors, error_rows(scene, load_edges(edges), read))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            Path(job.input.device),
            job.wildcards.kinematics,
            Path(job.input.edges),
            job.params.cases,
            [Path(path) for path in job.input.solutions],
            [Path(path) for path in job.input.filtered],
            Path(job.output.errors),
        )
