"""Which members of the ensemble have an effect, as many vary what another device has, and which have no solution."""

from __future__ import annotations

import pandas as pd

from .alternatives import AS_CONFIGURED


def with_effect(members: pd.DataFrame, *columns: str) -> pd.DataFrame:
    """Rows as configured, and those of members that have another value in one of the columns.

    members: rows of one half-cycle and one statement, or one correlation.
    """
    usual = members["varied"] == AS_CONFIGURED
    values = members[list(columns)].apply(tuple, axis=1)
    return members[usual | ~values.isin(values[usual])]


def without_solution(claims: pd.DataFrame) -> pd.DataFrame:
    """Statements, half-cycles and members (columns claim, half_cycle, varied) that have no verdict, where there is one
    as configured.

    claims: rows of the table of members' claims with one kinematics.
    """
    case = ["claim", "half_cycle", "varied"]
    usual = claims.loc[claims["varied"] == AS_CONFIGURED, case[:2]]
    every = usual.merge(claims[["varied"]].drop_duplicates(), how="cross")
    return every[~pd.MultiIndex.from_frame(every).isin(pd.MultiIndex.from_frame(claims[case]))]
