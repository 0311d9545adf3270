"""The paper's statements, each checked against computed scores and correlations."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import pandas as pd

from .statements import STATEMENTS, AbsentError, Kind, tables_of

COLUMNS = ["kinematics", "claim", "kind", "source", "holds", "evidence"]


def claims_table(scores: pd.DataFrame, correlations: pd.DataFrame) -> pd.DataFrame:
    """Which of the paper's statements hold.

    scores: columns kinematics, device, condition, dispersion, phase_deg, interface, readout, score [in `unit`, NaN
    without a prediction], score_error [in `unit`, NaN if it is not known], unit. correlations: from
    `correlation.correlation_table`, or its CSV read back.

    Returns the columns kinematics, claim, kind (see `Kind`), source, holds (see `Holds`) and evidence (a sentence with
    the numbers). To rise means by more than the sum of both errors. A claim which needs a score or a rating that is not
    there has no row: it is neither confirmed nor refuted.
    """
    rows = []
    for kinematics in scores["kinematics"].unique():
        tables = tables_of(*(table[table["kinematics"] == kinematics] for table in (scores, correlations)))
        for claim in STATEMENTS:
            try:
                holds, evidence = claim.check(tables)
            except AbsentError:
                continue
            rows.append((kinematics, claim.text, str(claim.kind), claim.source, str(holds), evidence))
    return pd.DataFrame(rows, columns=COLUMNS)


def verdict_counts(rows: Iterable[Mapping[str, Any]]) -> dict[str, Counter[str]]:
    """How many statements as the paper makes them end in each verdict, by kinematics. rows: of `claims_table`.

    >>> row = {"kinematics": "small", "kind": "stated", "holds": "yes"}
    >>> verdict_counts([row, row, row | {"holds": "undecided"}, row | {"kind": "weaker"}])
    {'small': Counter({'yes': 2, 'undecided': 1})}
    """
    counts: dict[str, Counter[str]] = {}
    for row in rows:
        if row["kind"] == Kind.STATED:
            counts.setdefault(row["kinematics"], Counter())[row["holds"]] += 1
    return counts
