"""Score what was solved in other ways, correlate these scores with perceived roughness, and check the statements."""

from pathlib import Path

import pandas as pd

from fingerpad.jobs import run
from fingerpad.perception.ratings import read_literature
from fingerpad.perception.scorings import scoring_tables
from fingerpad.readouts.accuracy import relative_errors
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.scorings import response_rows, scoring_rows
from fingerpad.scene.scene import with_all_kinematics
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, read_rows, read_table, write_rows, write_table


def main(
    config: Path,
    devices: list[Path],
    cases: list[tuple[str, ...]],
    filtered: list[Path],
    scores: Path,
    ratings: Path,
    order: Path,
    published: Path,
    conditions: dict[str, list[str]],
    scorings: Path,
    correlations: Path,
    claims: Path,
    response: Path,
) -> None:
    """Read scenes, filtered read-outs, errors of scores, and ratings, order and published numbers; write the scores,
    their correlations and claims, and what the filter leaves. cases: kinematics, device, condition and interface of
    every `filtered`. conditions: of every known device.
    """
    scenes = [load_scene(config, path) for path in devices]
    errors, read = relative_errors(read_rows(scores)), dict(zip(cases, filtered, strict=True))
    rows = [
        row
        for scene in with_all_kinematics(scenes)
        for condition in scene.device.conditions
        for interface in scene.device.interfaces()
        for path in [read[scene.kinematics, scene.device.name, condition.name, interface]]
        for row in scoring_rows(scene, condition, interface, load(path, FilteredReadouts), errors)
    ]
    write_rows(scorings, rows)
    literature = read_literature(ratings, order, published, conditions)
    found = scoring_tables(pd.DataFrame(rows), read_table(scores), literature)
    write_table(correlations, found.correlations)
    write_table(claims, found.claims)
    write_rows(response, [row for scene in scenes for row in response_rows(scene)])


if __name__ == "__main__":
    run(main, snakemake)
