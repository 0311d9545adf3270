"""What one should know before believing a score: of its solution, and of scores that lie close together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .readout import CONSTANT
from .roughness import KEY
from .scene import Scene
from .solution import Solution
from .tissue_law import Kinematics

MANY_SEARCHES = 10  # increments that did not settle at once [1]; source: shipped devices have up to 3
MANY_CUTS = 2  # halved increments [1]; source: shipped devices have up to 2, with finite kinematics
NEAR = 0.2  # of a certificate's limit [1]; source: shipped devices stay below 0.11

# Depth of an actuator over the pad's thickness [1]; source: mean strain is then 0.5, the logarithmic one 0.69: small
# strain is off by over a quarter. Shipped devices have up to 0.36
DEEP = 0.5
# Elements at edges that an actuator is wide [1]; source: with 7, a sharp pin of 0.1 mm goes as deep as with 28, to 1 %
FEW = 5.0


def solution_caveats(scene: Scene, solution: Solution) -> list[str]:
    """Actuators too deep for small strain, too narrow for the mesh or off the skin, many increments that were cut or
    did not settle at once, and figures of the certificate near their limits.
    """
    certificate = solution.certificate
    found = depth_caveats(scene, solution.depth)
    if left := _off_the_skin(scene, solution):
        numbers = ", ".join(map(str, left))
        found.append(f"actuators that leave the skin, counted from the left: {numbers}; positive normal is into it")
    elements = scene.device.actuators.width / scene.model.numerics.edges(scene.kinematics)[0]
    if elements < FEW:
        found.append(f"actuators are {elements:.1f} elements wide: try a smaller numerics.edge_size")
    if solution.cuts > MANY_CUTS:
        found.append(f"increments were halved {solution.cuts} times")
    if solution.searches > MANY_SEARCHES:
        found.append(f"{solution.searches} increments did not settle at once")
    shares = {
        "penetration": certificate.penetration_share,
        "tension": certificate.tension_share,
        "excess over the friction cone": certificate.cone_share,
    }
    found += [f"certificate: {name} is {share:.0%} of its limit" for name, share in shares.items() if share > NEAR]
    return found


def _off_the_skin(scene: Scene, solution: Solution) -> list[int]:
    """Numbers, from 1, of the actuators that are pressed onto the skin and touch it no more at some time."""
    row = scene.device.actuators
    nearest, count = row.nearest(solution.position[:, 0]), len(row.positions)
    pressing = np.array([np.bincount(nearest, each[:, 1], minlength=count) for each in solution.forces])
    return [int(number) + 1 for number in np.flatnonzero((pressing[0] > 0.0) & (pressing[1:] <= 0.0).any(axis=0))]


def depth_caveats(scene: Scene, depth: float) -> list[str]:
    """Whether actuators go too deep [mm] for small strain."""
    share = depth / scene.model.finger.pad_thickness
    deep = scene.kinematics is Kinematics.SMALL and share > DEEP
    return [f"actuators go {share:.0%} of the pad deep: small strain does not hold"] if deep else []


def score_caveats(rows: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    """For each row of the score table: which conditions' scores are closer than the larger of the two errors.

    Scores that are equal are equal stimuli, and no caveat. Rows without a score or an error have none.
    """
    found = []
    for row in rows:
        close = [
            str(other["condition"])
            for other in rows
            if all(row[column] == other[column] for column in KEY) and _indistinct(row, other)
        ]
        found.append([f"error is larger than the difference to {', '.join(close)}"] if close else [])
    return found


def _indistinct(row: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    if any(each.get("score_error") is None for each in (row, other)):
        return False
    difference = abs(row["score"] - other["score"])
    return bool(CONSTANT * abs(row["score"]) < difference < max(row["score_error"], other["score_error"]))
