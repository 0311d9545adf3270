"""Time set-up and solution of every device in one process, each step repeated, and write medians and spreads."""

from pathlib import Path

from fingerpad.benchmark.steps import step_rows
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import write_rows


def main(config: Path, devices: list[Path], finite: list[Path], repeats: dict[str, int], timings: Path) -> None:
    """Read the scenes, those of `finite` with finite kinematics too, time them, write one row per step."""
    scenes = [load_scene(config, path) for path in devices]
    scenes += [load_scene(config, path, Kinematics.FINITE) for path in finite]
    write_rows(timings, [row for scene in scenes for row in step_rows(scene, repeats[scene.kinematics])])


if __name__ == "__main__":
    run(main, snakemake)
