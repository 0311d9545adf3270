"""Mesh the finger's section for one device, and resample its receptors to a uniform grid."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.prediction.edges import edge_intervals, save_edges
from fingerpad.readouts.resampling import section_resampling
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import save
from fingerpad.tissue.mesh import mesh_section, save_section


def main(config: Path, device: Path, kinematics: Kinematics, edges: Path, mesh: Path, resampling: Path) -> None:
    """Read the scene, find its edges, mesh its section, write both, and what resamples the receptors' read-outs."""
    scene = load_scene(config, device, kinematics)
    intervals = edge_intervals(scene)
    save_edges(edges, intervals)
    section = mesh_section(scene, intervals)
    save_section(mesh, section)
    save(resampling, section_resampling(section, scene))


if __name__ == "__main__":
    run(main, snakemake)
