"""Pages of docs/ that say what was measured: prose from a template, every number from a table of results."""

from __future__ import annotations

from collections.abc import Mapping
from string import Template

import pandas as pd

from .. import markdown
from ..words import PERCENT, plain


def filled(template: str, values: Mapping[str, object]) -> str:
    """A template whose every ${name} is replaced. Raises KeyError if a value is missing."""
    return Template(template).substitute(values)


def table(rows: pd.DataFrame) -> str:
    """A Markdown table of a frame, its columns with spaces for underscores.

    >>> print(table(pd.DataFrame({"a_b": [1], "c": ["x"]})))
    | a b | c |
    |---|---|
    | 1 | x |
    """
    heads = [plain(str(column)) for column in rows.columns]
    return markdown.table(heads, rows.itertuples(index=False))


def percent(values: pd.Series) -> pd.Series:
    """Shares [1] as text."""
    return (PERCENT * values).map("{:.2f} %".format)


def digits(values: pd.Series) -> pd.Series:
    """Small numbers as text, with two digits."""
    return values.map("{:.1e}".format)
