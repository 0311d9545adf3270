"""Condense the finger to contact nodes and receptors, and the receptors to a uniform grid."""

from pathlib import Path

from fingerpad.condensation import condense_section
from fingerpad.mesh import load_section
from fingerpad.resampling import resampling_to_grid
from fingerpad.scenefile import load_scene
from fingerpad.store import save


def main(config: Path, device: Path, mesh: Path, condensed: Path, resampling: Path) -> None:
    """Read scene and mesh, condense, write compliance and strain map, and what resamples the receptors' read-outs."""
    scene = load_scene(config, device)
    section = condense_section(load_section(mesh), scene)
    save(condensed, section)
    save(resampling, resampling_to_grid(section.arc, scene.model.gabor.spacing))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.mesh),
        Path(job.output.condensed),
        Path(job.output.resampling),
    )
