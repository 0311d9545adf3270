"""Mesh the finger's section for one device."""

from pathlib import Path

from fingerpad.edges import mesh_device
from fingerpad.mesh import save_section
from fingerpad.scenefile import load_scene


def main(config: Path, device: Path, mesh: Path) -> None:
    """Read the scene, mesh its section, write it."""
    save_section(mesh, mesh_device(load_scene(config, device)))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.config), Path(job.input.device), Path(job.output.mesh))
