"""Draw strain and change of strain at the receptors of all devices."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.figures.receptors import DeviceReadouts, face_arcs, receptor_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load
from fingerpad.tissue.compliance import CondensedSection


def main(
    config: Path,
    devices: list[Path],
    condensed: list[Path],
    solutions: list[Path],
    cases: list[tuple[str, str]],
    filtered: list[Path],
    kinematics: Kinematics,
    png: Path,
) -> None:
    """Read every device's read-outs, draw, write PNG and PDF. cases: device and condition of every `filtered`."""
    read = dict(zip(cases, filtered, strict=True))
    entries = []
    for path, section, solution in zip(devices, condensed, solutions, strict=True):
        device = load_scene(config, path).device
        names = [condition.name for condition in device.conditions]
        readouts = {name: load(read[device.name, name], FilteredReadouts) for name in names}
        faces = face_arcs(device, load(section, CondensedSection), load(solution, Solution))
        entries.append(DeviceReadouts(device, readouts, faces))
    save(receptor_figure(entries, kinematics), png)


if __name__ == "__main__":
    run(main, snakemake)
