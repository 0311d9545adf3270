"""Score vibrations of one device, with shear, under other assumptions on how tissue relaxes."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.prediction.scoring import Condensed
from fingerpad.readouts.strain import Resampling
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, write_rows
from fingerpad.tissue.compliance import CondensedSection, load_body
from fingerpad.tissue.mesh import load_section
from fingerpad.vibration.frequency import without_caveats
from fingerpad.vibration.frequency_variants import relaxation_rows


def main(
    config: Path,
    device: Path,
    mesh: Path,
    condensed: Path,
    body: Path | None,
    resampling: Path,
    frequency: float,
    table: Path,
) -> None:
    """Read mesh and compliance, vibrate under each assumption, write the rows."""
    scene = load_scene(config, device)
    shared = Condensed(load(condensed, CondensedSection), load_body(body), load(resampling, Resampling))
    write_rows(table, without_caveats(relaxation_rows(scene, load_section(mesh), shared, frequency)))


if __name__ == "__main__":
    run(main, snakemake)
