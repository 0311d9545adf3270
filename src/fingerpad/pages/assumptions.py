"""The page of assumptions: where every value of scene files comes from, and what is assumed in code."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ..markdown import table
from ..scene.sources import Origin, Quantity, quantities

NUMERICAL = "numerical, "  # begins the source of an assumption that concerns the computation, not what is computed
NUMERICAL_CHOICES = "Numerical choices"
HEADINGS = {
    Origin.ASSUMPTION: ("Assumptions", "why"),
    Origin.PAPER: ("From the paper", "where"),
    Origin.REFERENCE: ("From other references", "reference"),
}
SECTIONS = {**dict(HEADINGS.values()), NUMERICAL_CHOICES: "why"}  # of the page, and what its last column is
INTRODUCTION = """\
# Assumptions, and where every other value comes from

Written by `snakemake docs` from the scene files; edit those, not this page. Units are mm, N, MPa and s; a number
without a unit has the unit 1. What is assumed in code, where no value can be changed, comes last.
"""
ASSUMED = re.compile(
    r"^ *# ASSUME: (?P<first>.*)(?P<rest>(?:\n *# (?!ASSUME: ).*)*)", re.MULTILINE
)  # a comment and the lines after it


def assumed(code: str) -> list[str]:
    """What the comments `# ASSUME:` of a module say, which begin with the key that they concern.

    >>> assumed("x = 1\\n# ASSUME: finger: it is\\n# round\\n# ASSUME: bone: so is it\\ny = 2")
    ['finger: it is round', 'bone: so is it']
    """
    return [" ".join(re.split(r"\n *# ", found["first"] + found["rest"])) for found in ASSUMED.finditer(code)]


def page(documents: Mapping[str, Mapping[str, Any]], modules: Mapping[str, str]) -> str:
    """Markdown page of all quantities of scene files by name: assumptions first, then the paper's, then references',
    then numerical choices; and of what modules, by path in the package, assume in code.
    """
    found = {name: quantities(document) for name, document in documents.items()}
    parts = [INTRODUCTION]
    for heading, reason in SECTIONS.items():
        parts.append(f"## {heading}\n")
        for name, listed in found.items():
            if chosen := [each for each in listed if _section(each) == heading]:
                cells = ((f"`{q.key}`", q.value, "" if q.unit == "1" else q.unit, q.source) for q in chosen)
                parts.append(f"### `{name}`\n\n{table(('key', 'value', 'unit', reason), cells)}\n")
    told = ((f"`{name}`", each) for name, code in modules.items() for each in assumed(code))
    parts.append(f"## In code\n\n{table(('module', 'what is assumed of which key'), told)}\n")
    return "\n".join(parts)


def _section(quantity: Quantity) -> str:
    """Where a quantity stands on the page."""
    if quantity.origin is Origin.ASSUMPTION and quantity.source.startswith(NUMERICAL):
        return NUMERICAL_CHOICES
    return HEADINGS[quantity.origin][0]
