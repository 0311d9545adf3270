"""Scores of one device from a coarser mesh and larger load increments."""

from pathlib import Path

from fingerpad.accuracy import COARSENING
from fingerpad.edges import load_edges
from fingerpad.prediction import rows_at
from fingerpad.scene import Kinematics
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, device: Path, kinematics: str, edges: Path, scores: Path) -> None:
    """Read the scene and its edges, solve all its conditions coarsely, write their scores."""
    scene = load_scene(config, device, Kinematics(kinematics))
    write_rows(scores, rows_at(scene, COARSENING, load_edges(edges)))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        job.wildcards.kinematics,
        Path(job.input.edges),
        Path(job.output.scores),
    )
