"""Values in place of those in scene files: what a variant of a scene differs in.

A key is spoken of as messages do: `actuators.pitch`, `finger.pad[2].modulus`.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum
from itertools import product
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..errors import SceneError, UsageError
from ..guess import closest, hint

Document = dict[str, Any]
NO_VALUES: Mapping[str, Any] = MappingProxyType({})  # in place of those in scene files: they are taken as they are
OPTION = "kinematics"  # is a column of the score table, and not read from files where scores are predicted


def variants(vary: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Every combination of the values of some keys, the last key's changing first; equal values count once.

    Without keys there is one combination, of nothing. Raises UsageError if that is no mapping of texts, if what stands
    at a key is no list of values that a scene file may hold, and if the key is `kinematics`.

    >>> variants({"contact.friction": [0.3, 0.6, 0.6], "actuators.pitch": [2.0]})
    [{'contact.friction': 0.3, 'actuators.pitch': 2.0}, {'contact.friction': 0.6, 'actuators.pitch': 2.0}]
    """
    if not isinstance(vary, Mapping) or not all(isinstance(key, str) and key.strip() for key in vary):
        raise UsageError(f"vary: found {vary!r}; allowed: keys as text, with a list of values for each")
    chosen: list[list[Any]] = []
    for key, values in vary.items():
        plain = _plain(values)
        if not isinstance(plain, list) or not plain or not _is_plain(plain):
            raise UsageError(f"vary: {key}: found {values!r}; allowed: a list of numbers, texts, or lists of these")
        if key == OPTION:
            raise UsageError(f"vary: found {key}; allowed: other keys, as kinematics are an option of their own")
        chosen.append([value for number, value in enumerate(plain) if value not in plain[:number]])
    return [dict(zip(vary, values, strict=True)) for values in product(*chosen)]


def _plain(value: Any) -> Any:
    """A value as a scene file may hold it: sequences as lists, numpy's numbers as Python's, words as text."""
    plain = value.tolist() if hasattr(value, "tolist") else value.value if isinstance(value, Enum) else value
    return [_plain(each) for each in plain] if isinstance(plain, list | tuple | range) else plain


def _is_plain(value: Any) -> bool:
    """Whether a scene file may hold a value; what it may be is for its schema to say."""
    if isinstance(value, list):
        return all(map(_is_plain, value))
    if isinstance(value, dict):
        return all(isinstance(key, str) and _is_plain(each) for key, each in value.items())
    return value is None or isinstance(value, bool | int | float | str)


def quantities_of(node: Any, key: str = "", by_names: bool = False) -> Iterator[tuple[str, Document]]:
    """Keys and quantities (mappings with a value, a unit and a source) of a document. by_names: call a list's entries
    that have a name by it.

    >>> [key for key, _ in quantities_of({"pad": [{"modulus": {"value": 2.0}}], "width": {"value": 16.0}})]
    ['pad[0].modulus', 'width']
    """
    if isinstance(node, dict) and "value" in node:
        yield key, node
    elif isinstance(node, dict):
        for name, child in node.items():
            yield from quantities_of(child, f"{key}.{name}" if key else str(name), by_names)
    elif isinstance(node, list):
        for number, child in enumerate(node):
            is_named = by_names and isinstance(child, dict) and "name" in child
            yield from quantities_of(child, f"{key}.{child['name']}" if is_named else f"{key}[{number}]", by_names)


def with_value(document: Document, key: str, value: Any, source: str) -> Document:
    """The document with another value at a key that has a quantity, and a source that says so.

    >>> document = {"contact": {"friction": {"value": 0.6, "unit": "1", "source": "..."}}}
    >>> with_value(document, "contact.friction", 0.3, "varied")
    {'contact': {'friction': {'value': 0.3, 'unit': '1', 'source': 'varied'}}}
    """
    found = copy.deepcopy(document)
    dict(quantities_of(found))[key].update(value=value, source=source)
    return found


def shared_out(values: Mapping[str, Any], documents: Mapping[Path, Document]) -> dict[Path, dict[str, Any]]:
    """The values of some keys by the first of the files that has a quantity there.

    Raises SceneError, with the key that was probably meant, if none has, and UsageError if two of the keys are one, a
    layer's called by its name and by its number.
    """
    found: dict[Path, dict[str, Any]] = {path: {} for path in documents}
    for asked, value in values.items():
        owner, key = _located(asked, documents)
        if key in found[owner]:
            raise UsageError(f"vary: found two keys that both are {key}; allowed: one, with all its values")
        found[owner][key] = value
    return found


def quantity_at(key: str, documents: Mapping[Path, Document]) -> Document:
    """The quantity at a key of the first of the files that has one. Raises SceneError as `shared_out`.

    >>> quantity_at("actuators.pitch", {Path("a.yaml"): {"actuators": {"pitch": {"value": 2.0, "unit": "mm"}}}})
    {'value': 2.0, 'unit': 'mm'}
    """
    owner, there = _located(key, documents)
    return dict(quantities_of(documents[owner]))[there]


def _located(asked: str, documents: Mapping[Path, Document]) -> tuple[Path, str]:
    """The first of the files that has a quantity at a key, and the key by numbers. Raises SceneError if none has."""
    key = by_number(asked, documents.values())
    known = {path: dict(quantities_of(document)) for path, document in documents.items()}
    for path, quantities in known.items():
        if key in quantities:
            return path, key
    if asked.rpartition(".")[2] == "kind":
        raise UsageError(f"vary: found {asked}; allowed: other keys, as each kind has keys of its own; write two files")
    named = [each for document in documents.values() for each, _ in quantities_of(document, by_names=True)]
    raise no_such_value(
        asked, " and ".join(map(str, known)), [*(each for keys in known.values() for each in keys), *named]
    )


def by_number(key: str, documents: Iterable[Document]) -> str:
    """A key in which a list's entry that is called by its name, as a layer may be, is called by its number.

    >>> by_number("pad.dermis.modulus", [{"pad": [{"name": "epidermis"}, {"name": "dermis", "modulus": 1.0}]}])
    'pad[1].modulus'
    """
    for document in documents:
        node: Any = document
        taken: list[str] = []
        for part in key.split("."):
            names = [each.get("name") for each in node if isinstance(each, dict)] if isinstance(node, list) else []
            if part in names:
                taken[-1] += f"[{names.index(part)}]"
                node = node[names.index(part)]
            else:
                taken.append(part)
                node = node.get(part) if isinstance(node, dict) else None
        if node is not None:
            return ".".join(taken)
    return key


def no_such_value(key: str, where: str, known: Sequence[str]) -> SceneError:
    """The error that a key is none of the known ones of some files, with the one that was probably meant: one that ends
    alike, or of which it is a part.
    """
    whole, _, last = key.rpartition(".")
    alike = [each for each in known if closest(last, [each.rpartition(".")[2]])]
    above = whole if whole in known else closest(key, alike)
    meant = next((each for each in known if each.endswith(f".{key}")), "") or above
    return SceneError(f"{key}: found no such value in {where}; allowed: a value that is written there{hint(meant)}")
