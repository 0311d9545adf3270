"""Condense the deformable body of a device's actuators to its face."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import save
from fingerpad.tissue.actuator_body import condense_body


def main(config: Path, device: Path, body: Path) -> None:
    """Read the scene, condense one actuator's body, write its compliance."""
    save(body, condense_body(load_scene(config, device)))


if __name__ == "__main__":
    run(main, snakemake)
