"""Values in place of those in scene files: what a variant of a scene differs in.

A key is spoken of as messages do: `actuators.pitch`, `finger.pad[2].modulus`.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from itertools import product
from typing import Any

from ..errors import SceneError

Document = dict[str, Any]
NO_VALUES: Mapping[str, Any] = {}  # in place of those in scene files: they are taken as they are


def variants(vary: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Every combination of the values of some keys, the last key's changing first.

    >>> variants({"contact.friction": [0.3, 0.6], "actuators.pitch": [2.0]})
    [{'contact.friction': 0.3, 'actuators.pitch': 2.0}, {'contact.friction': 0.6, 'actuators.pitch': 2.0}]
    """
    return [dict(zip(vary, values, strict=True)) for values in product(*vary.values())]


def quantity_at(document: Document, key: str) -> Document | None:
    """The quantity (a mapping with a value, a unit and a source) at a key, or None."""
    node: Any = document
    for step in re.findall(r"[^.\[\]]+", key):
        if isinstance(node, list):
            node = node[int(step)] if step.isdecimal() and int(step) < len(node) else None
        else:
            node = node.get(step) if isinstance(node, dict) else None
    return node if isinstance(node, dict) and "value" in node else None


def with_value(document: Document, key: str, value: Any, source: str) -> Document:
    """The document with another value at a key, and a source that says so. Raises SceneError if it has none there.

    >>> document = {"contact": {"friction": {"value": 0.6, "unit": "1", "source": "..."}}}
    >>> with_value(document, "contact.friction", 0.3, "varied")
    {'contact': {'friction': {'value': 0.3, 'unit': '1', 'source': 'varied'}}}
    """
    found = copy.deepcopy(document)
    quantity = quantity_at(found, key)
    if quantity is None:
        raise no_such_value(key, document)
    quantity["value"], quantity["source"] = value, source
    return found


def shared_out(values: Mapping[str, Any], *documents: Document) -> list[dict[str, Any]]:
    """The values of some keys by the first of the documents that has a quantity there. Raises SceneError if none has.

    >>> shared_out({"a.b": 2.0}, {"c": {"value": 1.0}}, {"a": {"b": {"value": 1.0}}})
    [{}, {'a.b': 2.0}]
    """
    found: list[dict[str, Any]] = [{} for _ in documents]
    for key, value in values.items():
        owner = next((own for own, each in zip(found, documents, strict=True) if quantity_at(each, key)), None)
        if owner is None:
            raise no_such_value(key, *documents)
        owner[key] = value
    return found


def no_such_value(key: str, *documents: Document) -> SceneError:
    """The error that a key is none of these documents', with the one that was probably meant."""
    known = [each for document in documents for each in quantity_keys(document)]
    close = [each for each in known if each.endswith(f".{key}")] or get_close_matches(key, known, n=1)
    hint = f"; did you mean {close[0]}?" if close else ""
    return SceneError(f"{key}: found no such value; allowed: a value in the scene files, such as {known[0]}{hint}")


def quantity_keys(node: Any, key: str = "") -> Iterator[str]:
    """Keys of all quantities in a document.

    >>> list(quantity_keys({"pad": [{"modulus": {"value": 2.0}}], "width": {"value": 16.0}}))
    ['pad[0].modulus', 'width']
    """
    if isinstance(node, dict) and "value" in node:
        yield key
    elif isinstance(node, dict):
        for name, child in node.items():
            yield from quantity_keys(child, f"{key}.{name}" if key else name)
    elif isinstance(node, list):
        for number, child in enumerate(node):
            yield from quantity_keys(child, f"{key}[{number}]")
