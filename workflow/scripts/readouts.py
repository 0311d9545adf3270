"""Score all solved conditions under other read-outs, and compare with the scores as configured."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import run
from fingerpad.prediction.other_readouts import agreement, on_both_sides, readout_rows
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, write_rows
from fingerpad.tissue.compliance import CondensedSection
from fingerpad.tissue.mesh import load_section


def main(
    config: Path,
    devices: list[Path],
    meshes: list[Path],
    condensed: list[Path],
    cases: list[tuple[str, ...]],
    solutions: list[Path],
    table: Path,
    compared: Path,
) -> None:
    """Read devices, their meshes and maps, and solutions; condense for the other side; write a row per score and a row
    per comparison. cases: kinematics, device, condition and interface of every solution.
    """
    solution = dict(zip(cases, solutions, strict=True))
    rows, compared_rows = [], []
    for path, mesh, stored in zip(devices, meshes, condensed, strict=True):
        scene = load_scene(config, path)
        sections = on_both_sides(scene, load(stored, CondensedSection), load_section(mesh))
        solved: dict[tuple[str, Interface], Solution] = {
            (condition.name, interface): load(
                solution[scene.kinematics, scene.device.name, condition.name, interface], Solution
            )
            for condition in scene.device.conditions
            for interface in scene.device.interfaces()
        }
        found = list(readout_rows(scene, sections, solved))
        rows += found
        compared_rows += agreement(found, scene.model.readout.side)
    write_rows(table, rows)
    write_rows(compared, compared_rows)


if __name__ == "__main__":
    run(main, snakemake)
