"""Where values come from: every quantity of scene files with its unit and source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any


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


def quantities(document: Mapping[str, Any]) -> list[Quantity]:
    """All quantities of a validated scene file, in its order.

    >>> found = quantities({"contact": {"friction": {"value": 0.6, "unit": "1", "source": "assumption: a guess"}}})
    >>> found[0].key, found[0].value, str(found[0].origin), found[0].source
    ('contact.friction', '0.6', 'assumption', 'a guess')
    """
    return list(_walked("", document))


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
