"""Draw scores between the phases at which devices are tried."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from fingerpad.figures.phases import phases_figure
from fingerpad.figures.style import save
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene


def main(config: Path, devices: Sequence[Path], table: Path, stem: Path) -> None:
    """Read the table and the devices, draw, write PNG and PDF."""
    shown = [load_scene(config, path).device for path in devices]
    save(phases_figure(shown, pd.read_csv(table)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            Path(job.input.table),
            Path(job.output.png).with_suffix(""),
        )
