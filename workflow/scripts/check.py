"""Scores of one device from a coarser mesh and larger load increments."""

from pathlib import Path

from fingerpad.accuracy import COARSENING
from fingerpad.edges import edge_intervals
from fingerpad.prediction import condense_scene, predicted_rows
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, device: Path, scores: Path) -> None:
    """Read the scene, solve all its conditions coarsely, write their scores."""
    scene = load_scene(config, device)
    coarser = scene.coarsened(COARSENING)
    write_rows(scores, predicted_rows(coarser, condense_scene(coarser, edge_intervals(scene))))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.config), Path(job.input.device), Path(job.output.scores))
