"""Score what was solved in other ways, correlate these scores with perceived roughness, and check the statements."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from fingerpad.jobs import logged
from fingerpad.perception.ratings import read_published, read_ratings, read_stated_order
from fingerpad.perception.scorings import scoring_tables
from fingerpad.readouts.accuracy import relative_errors
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.scorings import response_rows, scoring_rows
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, read_rows, write_rows, write_table


def main(
    config: Path,
    devices: Sequence[Path],
    filtered: Mapping[tuple[str, ...], Path],
    scores: Path,
    literature: tuple[Path, Path, Path],
    conditions: dict[str, list[str]],
    tables: dict[str, Path],
) -> None:
    """Read scenes, filtered read-outs (by kinematics, device, condition and interface), errors of scores, and ratings,
    order and published numbers; write the scores, their correlations and claims, and what the filter leaves.
    conditions: of every known device.
    """
    scenes = [load_scene(config, path) for path in devices]
    errors = relative_errors(read_rows(scores))
    rows = [
        row
        for kinematics in Kinematics
        for scene in (each.with_kinematics(kinematics) for each in scenes if kinematics in each.computed)
        for condition in scene.device.conditions
        for interface in scene.device.interfaces()
        for path in [filtered[kinematics, scene.device.name, condition.name, interface]]
        for row in scoring_rows(scene, condition, interface, load(path, FilteredReadouts), errors)
    ]
    write_rows(tables["scores"], rows)
    ratings, order, published = literature
    correlations, claims = scoring_tables(
        pd.read_csv(tables["scores"]),
        pd.read_csv(scores),
        read_ratings(ratings, conditions),
        read_stated_order(order, conditions),
        read_published(published),
    )
    write_table(tables["correlations"], correlations)
    write_table(tables["claims"], claims)
    write_rows(tables["response"], [row for scene in scenes for row in response_rows(scene)])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            dict(zip(job.params.cases, map(Path, job.input.filtered), strict=True)),
            Path(job.input.scores),
            (Path(job.input.ratings), Path(job.input.order), Path(job.input.published)),
            job.params.conditions,
            {name: Path(path) for name, path in job.output.items()},
        )
