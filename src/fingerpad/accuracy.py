"""Discretisation error of scores, estimated from a second, coarser solution.

Elements and load increments of the second solution are COARSENING times as large. With an order p of convergence the
error of the first is |difference| / (COARSENING^p - 1): twice the difference for p = 1, four fifths of it for p = 2.
Contact fronts converge with the first order, strains with the second, increments with the second; the difference
itself is what p = 1.7 gives. A single difference may vanish by chance, so no relative estimate is below the median of
those for the same device and read-out.
"""

from __future__ import annotations

import pandas as pd

COARSENING = 1.5  # [1]; source: the cheapest mesh whose errors still fall regularly (measured)
CASE = ["device", "condition", "interface", "readout"]
GROUP = ["device", "readout"]


def with_errors(scores: pd.DataFrame, coarser: pd.DataFrame) -> pd.DataFrame:
    """The score table with a column `score_error` behind `score`, in the same unit; empty where there is no score.

    coarser: score table of the coarser solution. Raises KeyError if it lacks a score.
    """
    indexed = scores.set_index(CASE)
    value = indexed["score"].astype(float)
    second = coarser.set_index(CASE)["score"].astype(float)
    predicted = value.dropna()
    relative = ((predicted - second.loc[predicted.index]) / predicted).abs()
    least = relative.groupby(GROUP).transform("median")
    error = (relative.clip(lower=least) * predicted).reindex(indexed.index)
    table = indexed.assign(score_error=error).reset_index()
    columns = list(scores.columns)
    columns.insert(columns.index("score") + 1, "score_error")
    return table[columns]
