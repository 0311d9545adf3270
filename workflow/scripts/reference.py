"""Scores of one device from a much finer mesh and smaller load increments: what errors are measured against."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.prediction.edges import edge_intervals
from fingerpad.prediction.scoring import rows_at
from fingerpad.readouts.accuracy import REFINEMENT
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import write_rows
from fingerpad.tissue.mesh import mesh_section


def main(config: Path, device: Path, kinematics: Kinematics, scores: Path) -> None:
    """Read the scene, find its edges, solve all its conditions finely, write their scores."""
    scene = load_scene(config, device, kinematics)
    edges = edge_intervals(scene)
    own, finer = (mesh_section(scene.coarsened(each), edges).unknowns for each in (1.0, 1.0 / REFINEMENT))
    rows = rows_at(scene, 1.0 / REFINEMENT, edges)
    write_rows(scores, [row | {"times_unknowns": f"{finer / own:.2f}"} for row in rows])


if __name__ == "__main__":
    run(main, snakemake)
