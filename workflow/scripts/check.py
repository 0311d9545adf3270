"""Scores of one device from a coarser mesh and larger load increments."""

from pathlib import Path

from fingerpad.accuracy import COARSENING
from fingerpad.prediction import rows_at
from fingerpad.scene import Kinematics
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, device: Path, kinematics: str, scores: Path) -> None:
    """Read the scene, solve all its conditions coarsely, write their scores."""
    write_rows(scores, rows_at(load_scene(config, device, Kinematics(kinematics)), COARSENING))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.config), Path(job.input.device), job.wildcards.kinematics, Path(job.output.scores))
