"""Gather all scores in one tidy table, with their errors."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.readouts.accuracy import read_cases, with_errors
from fingerpad.readouts.roughness import unpredicted_rows
from fingerpad.scene.scene import with_all_kinematics
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, devices: list[Path], scores: list[Path], checks: list[Path], table: Path) -> None:
    """Read every score, add the rows for which there is no prediction, and errors from the checks; write the table.
    scores: of every condition and interface of each scene with all kinematics. checks: of each.
    """
    scenes, files = [*with_all_kinematics([load_scene(config, device) for device in devices])], iter(scores)
    found, coarser, missing = [], [], []
    for scene, check in zip(scenes, checks, strict=True):
        cases = [(each.name, interface) for each in scene.device.conditions for interface in scene.device.interfaces()]
        found += [row for case in cases for row in read_cases(next(files), scene, [case])]
        coarser += read_cases(check, scene, cases)
        missing += unpredicted_rows(scene)
    write_rows(table, with_errors([*found, *missing], coarser))


if __name__ == "__main__":
    run(main, snakemake)
