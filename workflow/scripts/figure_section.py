"""Draw the finger's section with its layers and the devices' actuators."""

from pathlib import Path

from fingerpad.figures.section import section_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.tissue.mesh import load_section


def main(config: Path, devices: list[Path], mesh: Path, png: Path) -> None:
    """Read the scenes and one device's mesh, draw, write PNG and PDF."""
    scenes = [load_scene(config, path) for path in devices]
    save(section_figure(scenes[0].model, load_section(mesh), [scene.device for scene in scenes]), png)


if __name__ == "__main__":
    run(main, snakemake)
