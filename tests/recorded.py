"""Scores as tests/expected records them. As a program: whether a table holds them, for both kinematics.

If a change is meant, copy results/scores.csv over the recorded one.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

RECORDED = Path(__file__).with_name("expected") / "scores.csv"
KEY = ["kinematics", "device", "condition", "interface", "readout"]
# Relative [1]. Another processor rounds differently: kernels of linear algebra for one without vectors of 256 bits move
# scores by 1.6e-7, and their errors by 2.3e-6, at most (measured); the rest is left to processors that were not tried
TOLERANCE = 1e-5
ERROR_TOLERANCE = 1e-3


def not_as_recorded(table: Path, kinematics: list[str]) -> str:
    """What a score table has otherwise than recorded, in words; nothing if it has all of these kinematics as it is."""
    found, expected = (pd.read_csv(path).set_index(KEY).sort_index() for path in (table, RECORDED))
    expected = expected.loc[kinematics]
    if not found.index.equals(expected.index):
        return f"rows: {sorted(set(found.index) ^ set(expected.index))}"
    for column, tolerance in (("score", TOLERANCE), ("score_error", ERROR_TOLERANCE)):
        both = pd.DataFrame({"found": found[column], "expected": expected[column]})
        off = ~np.isclose(both["found"], both["expected"], rtol=tolerance, atol=0.0, equal_nan=True)
        if off.any():
            return f"{column}:\n{both[off]}"
    for column in ("unit", "note"):
        if not found[column].fillna("").equals(expected[column].fillna("")):
            return column
    return ""


if __name__ == "__main__":
    sys.exit(not_as_recorded(Path(sys.argv[1]), ["finite", "small"]) or None)
