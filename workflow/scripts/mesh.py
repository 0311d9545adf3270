"""Mesh the finger's section for one device, and resample its receptors to a uniform grid."""

from pathlib import Path

from fingerpad.condensation import arc_length, receptor_strain
from fingerpad.edges import mesh_device
from fingerpad.mesh import save_section
from fingerpad.resampling import resampling_to_grid
from fingerpad.scene import Kinematics
from fingerpad.scenefile import load_scene
from fingerpad.store import save


def main(config: Path, device: Path, kinematics: str, mesh: Path, resampling: Path) -> None:
    """Read the scene, mesh its section, write it, and what resamples the receptors' read-outs."""
    scene = load_scene(config, device, Kinematics(kinematics))
    section = mesh_device(scene)
    save_section(mesh, section)
    receptor, _ = receptor_strain(section, scene)
    save(resampling, resampling_to_grid(arc_length(receptor), scene.model.gabor.spacing))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        job.wildcards.kinematics,
        Path(job.output.mesh),
        Path(job.output.resampling),
    )
