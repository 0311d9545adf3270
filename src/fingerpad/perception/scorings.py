"""How other scorings correlate with perceived roughness, and which of the paper's statements hold with them."""

from __future__ import annotations

import pandas as pd

from ..readouts.scorings import Scoring
from .evaluation import Evaluation, evaluate
from .ratings import Literature


def scoring_tables(others: pd.DataFrame, configured: pd.DataFrame, literature: Literature) -> Evaluation:
    """Correlations and claims of every scoring, the configured one first, in the columns of their tables behind
    `scoring`.

    others: rows of the score table with errors behind `scoring` (`readouts.scorings.scoring_rows`). configured: the
    score table. Raises RatingError as `correlation_table`.
    """
    scores = pd.concat([configured.assign(scoring=str(Scoring.CONFIGURED)), others])
    return evaluate(scores, ["scoring"], literature)
