"""Time scenes of growing size, and fit how cost grows."""

from pathlib import Path

from fingerpad.benchmark.growth import exponents, growth
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(
    config: Path, device: Path, factors: list[float], counts: list[int], repeats: int, sizes: Path, fits: Path
) -> None:
    """Read the scene, time its variants, write one row each, and the exponents."""
    rows = list(growth(load_scene(config, device), factors, counts, repeats))
    write_rows(sizes, rows)
    write_rows(fits, exponents(rows))


if __name__ == "__main__":
    run(main, snakemake)
