"""Condense the deformable body of a device's actuators to its face."""

from pathlib import Path

from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import save
from fingerpad.tissue.actuator_body import condense_body


def main(config: Path, device: Path, body: Path) -> None:
    """Read the scene, condense one actuator's body, write its compliance."""
    save(body, condense_body(load_scene(config, device)))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(Path(job.input.config), Path(job.input.device), Path(job.output.body))
