"""What one should know before believing a score: of its solution, and of scores that lie close together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .readout import CONSTANT
from .roughness import KEY
from .scene import Scene
from .solution import Solution
from .tissue_law import Kinematics

MANY_SEARCHES = 10  # increments that did not settle at once [1]; source: shipped devices have up to 3
NEAR = 0.1  # of a certificate's limit [1]; source: shipped devices stay below 0.05

# Indentation over the pad's thickness [1]; source: the mean strain is then 0.5, the logarithmic one 0.69: small strain
# is off by more than a quarter. Shipped devices have up to 0.35
DEEP = 0.5


def solution_caveats(scene: Scene, solution: Solution) -> list[str]:
    """Indentation too deep for small strain, increments that were cut or did not settle at once, and figures of the
    certificate near their limits.
    """
    certificate = solution.certificate
    found = []
    depth = solution.indentation / scene.model.finger.pad_thickness
    if scene.kinematics is Kinematics.SMALL and depth > DEEP:
        found.append(f"indentation is {depth:.0%} of the pad: small strain does not hold")
    if solution.cuts:
        found.append(f"increments were halved {'once' if solution.cuts == 1 else f'{solution.cuts} times'}")
    if solution.searches > MANY_SEARCHES:
        found.append(f"{solution.searches} increments did not settle at once")
    shares = {
        "penetration": certificate.penetration_share,
        "tension": certificate.tension_share,
        "excess over the friction cone": certificate.cone_share,
    }
    found += [f"certificate: {name} is {share:.0%} of its limit" for name, share in shares.items() if share > NEAR]
    return found


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
