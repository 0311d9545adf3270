"""Draw the strain maps and contact tractions of one device and dispersion."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.fields.section_fields import Fields
from fingerpad.figures.maps import strain_map_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load


def main(
    kinematics: Kinematics, config: Path, device: Path, fields: Path, solutions: list[Path], dispersion: str, png: Path
) -> None:
    """Read fields and solutions (in the order of the distinct conditions), draw, write PNG and PDF."""
    scene = load_scene(config, device, kinematics)
    names = [condition.name for condition in scene.device.distinct_conditions]
    save(
        strain_map_figure(
            scene,
            dispersion,
            load(fields, Fields),
            {name: load(path, Solution) for name, path in zip(names, solutions, strict=True)},
        ),
        png,
    )


if __name__ == "__main__":
    run(main, snakemake)
