"""Solve all conditions of the devices with more increments, and write how far scores move."""

from pathlib import Path

from fingerpad.benchmark.increments import increment_rows
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import read_rows, write_rows


def main(config: Path, devices: list[Path], scores: Path, multiples: list[int], table: Path) -> None:
    """Read scenes and scores, write one row per device, multiple and read-out."""
    stated = read_rows(scores)
    rows = [row for path in devices for row in increment_rows(load_scene(config, path), multiples, stated)]
    write_rows(table, rows)


if __name__ == "__main__":
    run(main, snakemake)
