"""Scores of one device from two coarser meshes and larger load increments, if they can be had."""

from pathlib import Path

from fingerpad.edges import load_edges
from fingerpad.jobs import plain_errors
from fingerpad.prediction import coarser_rows
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows
from fingerpad.tissue_law import Kinematics


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
