"""Score the filtered read-outs of one device, condition and interface."""

import csv
from pathlib import Path

from fingerpad.roughness import score_rows
from fingerpad.scene import Interface
from fingerpad.scenefile import load_scene
from fingerpad.store import load
from fingerpad.strain import FilteredReadouts


def main(config: Path, device: Path, filtered: Path, condition: str, interface: str, score: Path) -> None:
    """Read the filtered read-outs, integrate them, write one row a read-out."""
    scene = load_scene(config, device)
    rows = score_rows(scene, scene.device.condition(condition), Interface(interface), load(filtered, FilteredReadouts))
    with score.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.filtered),
        job.wildcards.condition,
        job.wildcards.interface,
        Path(job.output.score),
    )
