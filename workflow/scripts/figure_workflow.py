"""Draw one device's way from receptor strains to scores."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.figures.receptors import DeviceReadouts, face_arcs
from fingerpad.figures.style import rows_with, save
from fingerpad.figures.workflow import workflow_figure
from fingerpad.jobs import run
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, read_table
from fingerpad.tissue.compliance import CondensedSection


def main(
    config: Path, device: Path, condensed: Path, solution: Path, filtered: list[Path], scores: Path, png: Path
) -> None:
    """Read one device's read-outs (in the order of its conditions) and its scores, draw, write PNG and PDF."""
    scene = load_scene(config, device)
    names = [condition.name for condition in scene.device.conditions]
    readouts = {name: load(path, FilteredReadouts) for name, path in zip(names, filtered, strict=True)}
    faces = face_arcs(scene.device, load(condensed, CondensedSection), load(solution, Solution))
    entry = DeviceReadouts(scene.device, readouts, faces)
    table = rows_with(read_table(scores), Kinematics.SMALL)
    own = table[(table["device"] == scene.device.name) & (table["interface"] == Interface.SHEAR)]
    save(workflow_figure(scene, entry, own), png)


if __name__ == "__main__":
    run(main, snakemake)
