"""Gather all scores in one tidy table, with their errors."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.readouts.accuracy import with_errors
from fingerpad.readouts.roughness import unpredicted_rows
from fingerpad.scene.scene import with_all_kinematics
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import read_rows, write_rows


def main(config: Path, devices: list[Path], scores: list[Path], checks: list[Path], table: Path) -> None:
    """Read every score, add the rows for which there is no prediction, and errors from the checks; write the table."""
    found = [row for path in scores for row in read_rows(path)]
    coarser = [row for path in checks for row in read_rows(path)]
    scenes = [load_scene(config, device) for device in devices]
    missing = [row for scene in with_all_kinematics(scenes) for row in unpredicted_rows(scene)]
    write_rows(table, with_errors([*found, *missing], coarser))


if __name__ == "__main__":
    run(main, snakemake)
