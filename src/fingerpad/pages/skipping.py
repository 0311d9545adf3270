"""The page on what is skipped, and what that saves."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from .filling import digits, table


def skipping_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/skipping.md` asks for. tables: switches, always."""
    switches, always = tables["switches"], tables["always"]
    names = {"setup_ratio": "set-up", "conditions_ratio": "all conditions", "total_ratio": "both"}
    shown = switches.rename(columns=names)
    for column in ("largest_difference", "smallest_stated_error"):
        shown[column] = digits(shown[column])
    return {"switches": table(shown), "always": table(always)}
