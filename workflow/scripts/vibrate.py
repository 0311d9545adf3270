"""Score the conditions of one device as vibrations."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.prediction.scoring import Condensed
from fingerpad.readouts.strain import Resampling
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, write_rows
from fingerpad.tissue.compliance import CondensedSection, load_body
from fingerpad.tissue.mesh import load_section
from fingerpad.vibration.frequency import vibration_rows, without_caveats


def main(
    config: Path, device: Path, mesh: Path, condensed: Path, body: Path | None, resampling: Path, scores: Path
) -> None:
    """Read mesh and compliance, vibrate, write the rows."""
    scene, section = load_scene(config, device), load_section(mesh)
    shared = Condensed(load(condensed, CondensedSection), load_body(body), load(resampling, Resampling))
    write_rows(scores, without_caveats(vibration_rows(scene, section, shared)))


if __name__ == "__main__":
    run(main, snakemake)
