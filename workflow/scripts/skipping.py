"""Turn every skip off in turn, and write what that costs and how far scores move."""

from pathlib import Path

from fingerpad.benchmark.skipping import always_rows, skip_rows
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_rows, write_rows


def main(
    config: Path,
    devices: list[Path],
    finite: list[Path],
    scores: Path,
    repeats: dict[str, int],
    switches: Path,
    always: Path,
) -> None:
    """Read scenes and scores, time every device with and without every skip, some with finite kinematics too, write two
    tables.
    """
    stated = read_rows(scores)
    scenes = [load_scene(config, path) for path in devices]
    deformed = [load_scene(config, path, Kinematics.FINITE) for path in finite]
    rows = [row for scene in scenes + deformed for row in skip_rows(scene, stated, repeats[scene.kinematics])]
    write_rows(switches, rows)
    write_rows(always, [row for scene in scenes for row in always_rows(scene, repeats[scene.kinematics])])


if __name__ == "__main__":
    run(main, snakemake)
