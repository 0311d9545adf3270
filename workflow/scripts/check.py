"""Errors of one device's scores, from a solution on a coarser mesh with larger load increments."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import run
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
    kinematics: Kinematics,
    edges: Path,
    cases: list[tuple[str, Interface]],
    solutions: list[Path],
    filtered: list[Path],
    errors: Path,
) -> None:
    """Read the scene, its edges and what was read in all cases, solve them coarsely, write errors."""
    scene = load_scene(config, device, kinematics)
    read = {
        (condition, interface): ReadSolution(load(solved, Solution), load(path, FilteredReadouts))
        for (condition, interface), solved, path in zip(cases, solutions, filtered, strict=True)
    }
    write_rows(errors, error_rows(scene, load_edges(edges), read))


if __name__ == "__main__":
    run(main, snakemake)
