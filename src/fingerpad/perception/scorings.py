"""How other scorings correlate with perceived roughness, and which of the paper's statements hold with them."""

from __future__ import annotations

import pandas as pd

from ..readouts.scorings import Scoring
from .claims import claims_table
from .correlation import correlation_table
from .ratings import Literature


def scoring_tables(
    others: pd.DataFrame, configured: pd.DataFrame, literature: Literature
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Correlations and claims of every scoring, in the columns of their tables behind `scoring`.

    others: rows of the score table with errors behind `scoring` (`readouts.scorings.scoring_rows`). configured: the
    score table. Raises RatingError as `correlation_table`.
    """
    correlations: list[pd.DataFrame] = []
    claims: list[pd.DataFrame] = []
    for scoring, scores in (
        (str(Scoring.CONFIGURED), configured),
        *((str(name), rows.drop(columns="scoring")) for name, rows in others.groupby("scoring", sort=False)),
    ):
        table = correlation_table(scores, literature)
        for found, own in ((correlations, table), (claims, claims_table(scores, table))):
            own.insert(0, "scoring", scoring)
            found.append(own)
    return pd.concat(correlations), pd.concat(claims)
