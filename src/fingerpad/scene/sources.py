"""Where values come from: every quantity of scene files with its unit and source, and what is assumed in code.

`page` lists them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from ..markdown import table


class Origin(StrEnum):
    """Where a value comes from: it was assumed, it is in the paper, or another reference has it."""

    ASSUMPTION = "assumption"
    PAPER = "paper"
    REFERENCE = "reference"


@dataclass(frozen=True)
class Quantity:
    """A value of a scene file as text. key: dotted, layers by their names. source: without the word for its origin."""

    key: str
    value: str
    unit: str
    origin: Origin
    source: str


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


def quantities(document: Mapping[str, Any]) -> list[Quantity]:
    """All quantities of a validated scene file, in its order.

    >>> found = quantities({"contact": {"friction": {"value": 0.6, "unit": "1", "source": "assumption: a guess"}}})
    >>> found[0].key, found[0].value, str(found[0].origin), found[0].source
    ('contact.friction', '0.6', 'assumption', 'a guess')
    """
    return list(_walked("", document))


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


def _walked(key: str, node: Any) -> Iterator[Quantity]:
    """Quantities below a node: a mapping with a source is one, and where its value is a kind it may hold others."""
    if isinstance(node, Mapping):
        if "source" in node:
            yield _quantity(key, node)
        for name, child in node.items():
            yield from _walked(f"{key}.{name}" if key else name, child)
    elif isinstance(node, list):
        for number, child in enumerate(node):
            name = child.get("name", number) if isinstance(child, Mapping) else number
            yield from _walked(f"{key}.{name}", child)


def _quantity(key: str, node: Mapping[str, Any]) -> Quantity:
    word, _, rest = str(node["source"]).partition(": ")
    origin = Origin(word) if rest and word in {Origin.ASSUMPTION, Origin.PAPER} else Origin.REFERENCE
    source = str(node["source"]) if origin is Origin.REFERENCE else rest
    return Quantity(key, _text(node.get("value", node.get("kind", ""))), str(node.get("unit", "1")), origin, source)


def _text(value: Any) -> str:
    """A value as the scene file writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    return ", ".join(map(_text, value)) if isinstance(value, list) else str(value)
