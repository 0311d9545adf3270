"""Gather all scores in one tidy table, with their errors."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.readouts.accuracy import with_errors
from fingerpad.readouts.roughness import unpredicted_rows
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_rows, write_rows


def main(config: Path, devices: list[Path], scores: list[Path], checks: list[Path], table: Path) -> None:
    """Read every score, add the rows for which there is no prediction, and errors from the checks; write the table."""
    found = [row for path in scores for row in read_rows(path)]
    coarser = [row for path in checks for row in read_rows(path)]
    scenes = [load_scene(config, device) for device in devices]
    missing = [
        row
        for each in Kinematics
        for scene in scenes
        if each in scene.computed
        for row in unpredicted_rows(scene.with_kinematics(each))
    ]
    write_rows(table, with_errors([*found, *missing], coarser))


if __name__ == "__main__":
    run(main, snakemake)
