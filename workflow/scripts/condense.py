"""Condense the finger to contact nodes and receptors."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import save
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.mesh import load_section


def main(config: Path, device: Path, mesh: Path, condensed: Path) -> None:
    """Read scene and mesh, condense, write compliance and strain map."""
    save(condensed, condense_section(load_section(mesh), load_scene(config, device)))


if __name__ == "__main__":
    run(main, snakemake)
