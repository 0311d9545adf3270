"""Time one condition on ladders of meshes, by fingerpad, a plain solver and CalculiX, with the errors of its scores."""

from pathlib import Path
from typing import Any

from fingerpad.benchmark.calculix_ladder import calculix_ladder
from fingerpad.benchmark.ladder import first_order_ladder, own_ladder, plain_ladder, reference_rows
from fingerpad.calculix.case import case_of
from fingerpad.calculix.program import SKIPPED, installed
from fingerpad.errors import CalculixError
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import alike, read_rows, write_rows


def main(
    config: Path,
    device: Path,
    reference: Path,
    kinematics: list[Kinematics],
    finest: float,
    condition: str,
    factors: dict[str, dict[str, list[float]]],
    cases: dict[str, dict[str, Any]],
    limit: float,
    repeats: dict[str, int],
    decks: Path,
    table: Path,
) -> None:
    """Read scene and small kinematics' reference, climb every ladder, write a row per mesh. With finite kinematics the
    reference is a mesh of `finest` [1] times the sizes. CalculiX's are left out without ccx, and where a deck fails.
    """
    rows: list[dict[str, Any]] = []
    for each in kinematics:
        scene, climbed = load_scene(config, device, each), factors[each]
        asked = scene.device.condition(condition)
        wanted = read_rows(reference) if each is Kinematics.SMALL else reference_rows(scene, asked, finest)
        rows += own_ladder(scene, asked, climbed["fingerpad"], wanted, repeats[each])
        if climbed["first_order"]:
            rows += first_order_ladder(scene, asked, climbed["first_order"], wanted, repeats[each])
        if climbed["plain"]:
            rows += plain_ladder(scene, asked, climbed["plain"], wanted)
        folder = decks / each
        folder.mkdir(parents=True, exist_ok=True)
        if not installed():
            print(f"CalculiX {SKIPPED}")
            continue
        try:
            rows += calculix_ladder(scene, asked, climbed["calculix"], case_of(cases[each]), folder, limit)
        except CalculixError as error:
            print(f"CalculiX's ladder is left out: {error}")
    write_rows(table, alike(rows))


if __name__ == "__main__":
    run(main, snakemake)
