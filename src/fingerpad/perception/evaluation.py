"""Several kinds of scores against the literature: how each correlates, and which of the paper's statements hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from .claims import claims_table
from .correlation import correlation_table
from .ratings import Literature


@dataclass(frozen=True)
class Evaluation:
    """Correlations and claims of kinds of scores, in the columns of their tables behind those that tell kinds apart."""

    correlations: pd.DataFrame
    claims: pd.DataFrame


def evaluate(scores: pd.DataFrame, kind: Sequence[str], literature: Literature) -> Evaluation:
    """The `correlation_table` and the `claims_table` of every kind of scores.

    scores: rows of the score table with errors. kind: columns of it that tell kinds apart. Raises RatingError as
    `correlation_table`.
    """
    correlations: list[pd.DataFrame] = []
    claims: list[pd.DataFrame] = []
    for values, own in scores.groupby(list(kind), sort=False):
        labels = dict(zip(kind, values, strict=True))
        table = correlation_table(own, literature)
        correlations.append(_labelled(table, labels))
        claims.append(_labelled(claims_table(own, table), labels))
    return Evaluation(pd.concat(correlations), pd.concat(claims))


def _labelled(table: pd.DataFrame, labels: Mapping[str, str]) -> pd.DataFrame:
    """The table behind a column of each label."""
    return table.assign(**labels)[[*labels, *table.columns.difference([*labels], sort=False)]]
