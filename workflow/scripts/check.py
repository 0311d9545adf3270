"""Scores of one device from two coarser meshes and larger load increments, if they can be had."""

from pathlib import Path

from fingerpad.jobs import plain_errors
from fingerpad.prediction.edges import load_edges
from fingerpad.prediction.scoring import coarser_rows
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import write_rows


def main(config: Path, device: Path, kinematics: str, edges: Path, scores: Path) -> None:
    """Read the scene and its edges, solve all its conditions coarsely, twice, write their scores."""
    scene = load_scene(config, device, Kinematics(kinematics))
    write_rows(scores, coarser_rows(scene, load_edges(edges)))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with plain_errors(job.log):
        main(
            Path(job.input.config),
            Path(job.input.device),
            job.wildcards.kinematics,
            Path(job.input.edges),
            Path(job.output.scores),
        )
