"""Which members of the ensemble have an effect: many vary what another device has, or other kinematics."""

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
