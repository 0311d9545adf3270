"""The page on what is skipped, and what that saves."""

from __future__ import annotations

import pandas as pd

from .filling import digits, table


def skipping_values(switches: pd.DataFrame, always: pd.DataFrame) -> dict[str, object]:
    """What `workflow/pages/skipping.md` asks for."""
    names = {"setup_ratio": "set-up", "conditions_ratio": "all conditions", "total_ratio": "both"}
    shown = switches.rename(columns=names)
    for column in ("largest_difference", "smallest_stated_error"):
        shown[column] = digits(shown[column])
    return {"switches": table(shown), "always": table(always)}
