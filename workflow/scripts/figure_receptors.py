"""Draw strain and change of strain at the receptors of all devices."""

from collections.abc import Mapping
from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.figures.receptors import DeviceReadouts, face_arcs, receptor_figure
from fingerpad.figures.style import save
from fingerpad.jobs import logged
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
    filtered: Mapping[tuple[str, str], Path],
    kinematics: str,
    stem: Path,
) -> None:
    """Read every device's read-outs (by device and condition), draw, write PNG and PDF."""
    entries = []
    for path, section, solution in zip(devices, condensed, solutions, strict=True):
        device = load_scene(config, path).device
        names = [condition.name for condition in device.conditions]
        readouts = {name: load(filtered[device.name, name], FilteredReadouts) for name in names}
        faces = face_arcs(device, load(section, CondensedSection), load(solution, Solution))
        entries.append(DeviceReadouts(device, readouts, faces))
    save(receptor_figure(entries, Kinematics(kinematics)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            [Path(path) for path in job.input.condensed],
            [Path(path) for path in job.input.solutions],
            dict(zip(job.params.cases, map(Path, job.input.filtered), strict=True)),
            job.params.kinematics,
            Path(job.output.png).with_suffix(""),
        )
