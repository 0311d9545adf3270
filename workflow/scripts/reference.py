"""Scores of one device from a much finer mesh and smaller load increments: what errors are measured against."""

from pathlib import Path

from fingerpad.accuracy import REFINEMENT
from fingerpad.prediction import rows_at
from fingerpad.scene import Kinematics
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, device: Path, kinematics: Kinematics, scores: Path) -> None:
    """Read the scene, solve all its conditions finely, write their scores."""
    write_rows(scores, rows_at(load_scene(config, device, kinematics), 1.0 / REFINEMENT[kinematics]))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.config), Path(job.input.device), Kinematics(job.wildcards.kinematics), Path(job.output.scores))
