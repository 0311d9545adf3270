"""The page of the paper's statements: the verdict on each, and the numbers behind it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import pandas as pd

from ..perception.claims import verdict_counts
from ..perception.verdicts import Holds
from .filling import table


def claims_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/claims.md` asks for. tables: claims, of `claims.claims_table`."""
    claims = tables["claims"]
    return {
        "counts": "\n".join(_counted(*each) for each in verdict_counts(claims.to_dict("records")).items()),
        "verdicts": table(_verdicts(claims)),
        "evidence": "\n\n".join(_evidence(claim, own) for claim, own in claims.groupby("claim", sort=False)),
    }


def _counted(kinematics: str, counts: Counter[str]) -> str:
    """How many statements end in each verdict, in words."""
    numbers = ", ".join(f"{counts[each]} {each}" for each in Holds)
    return f"- With {kinematics} kinematics, of {counts.total()} stated claims: {numbers}."


def _verdicts(claims: pd.DataFrame) -> pd.DataFrame:
    """A row per statement, a column of verdicts for each kinematics; empty where there is none."""
    told = ["claim", "kind", "source"]
    wide = claims.pivot(index=told, columns="kinematics", values="holds").fillna("")
    kinematics = list(claims["kinematics"].unique())
    rows = wide.reindex(pd.MultiIndex.from_frame(claims[told].drop_duplicates())).reset_index()
    return rows[["claim", "kind", *kinematics, "source"]].rename(columns={"claim": "statement"})


def _evidence(claim: object, own: pd.DataFrame) -> str:
    """A statement with the numbers of each kinematics."""
    lines = [f"- {row.kinematics}, {row.holds}: {row.evidence}" for row in own.itertuples()]
    return "\n".join([f"**{claim}**", "", *lines])
