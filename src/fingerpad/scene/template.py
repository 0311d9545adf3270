"""A new device file from another device: its values, and what the schema says of every key as comments."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from textwrap import wrap
from typing import Any

import yaml

from .schema import Schema, allowed_values

LINE = 110  # characters of a comment's line [1]
STEP = "  "  # of indentation

HEADER = """\
# {name}: a device for fingerpad. Every value has its unit and its source: "paper: ...", "assumption: why", or
# a reference. All are those of {origin}, as their sources say: change value and source together.
# Check it with `fingerpad check`, predict its roughness with `fingerpad predict` or `snakemake all`.
# The file name is the device's name. Ratings of perceived roughness are optional: rows in data/ratings.csv.
# Where finite strain cannot follow a stroke, this line leaves it out:
#   kinematics: {{value: small, unit: "1", source: "assumption: finite strain cannot follow these strokes"}}
# Where nothing holds the row without friction, this line predicts it with friction alone:
#   interfaces: {{value: shear, unit: "1", source: "assumption: without friction this row cannot be held"}}
# Friction and preload of your experiment, in place of those in config.yaml (criterion, depth and force, too):
#   contact: {{friction: {{value: 0.4, unit: "1", source: "measured by whom, on what"}}}}
"""
DRIVES = """\
# How to change the drive:
# - normal, lateral or both at once: `direction` below, where the stimulus has one.
# - displacements measured on the device: replace all of `stimulus` by the following. A recording is a CSV file beside
#   this one with the columns time [s], actuator (1 is the left one), normal and tangential [mm], and a row for every
#   actuator at every time; displacements count from the pre-indented position, positive into the skin and to the right.
#stimulus:
#  kind: measured
#  recordings:
#    tap:  # name of the condition
#      dispersion: {value: measured, unit: "1", source: "assumption: a name for conditions that are listed together"}
#      phase: {value: 0, unit: deg, source: "assumption: phase difference under which it is listed"}
#      file: {value: tap.csv, unit: "1", source: "measured by whom, when and how"}
# - displacements written here, at any times: `kind: history`; every kind is in workflow/schemas/device.schema.yaml.
"""


def device_text(name: str, origin: str, document: Mapping[str, Any], schema: Schema) -> str:
    """Text of a device file with the document's values. Its title says `name`, so that figures tell the two apart.

    Its sources say that the values are those of the device `origin`, and where that has them from: what is in the paper
    of one device is an assumption of another.

    document: a valid device. schema: as `validation.checked_document` gives it for that document.
    """
    title = {"value": name, "unit": "1", "source": "assumption: a new device is called by its name"}
    lines = list(_mapping({**_copied(document, origin), "title": title}, schema, 0, set()))
    start = lines.index("stimulus:")
    while lines[start - 1].startswith("#"):
        start -= 1
    return (
        HEADER.format(name=name, origin=origin)
        + "\n".join([*lines[:start], *DRIVES.splitlines(), *lines[start:]])
        + "\n"
    )


def _copied(node: Any, origin: str) -> Any:
    """A part of a document with sources that name the device whose values it has."""
    if isinstance(node, list):
        return [_copied(child, origin) for child in node]
    if not isinstance(node, dict):
        return node
    return {
        key: f"assumption: as {origin} ({child.removeprefix('assumption: ')})"
        if key == "source"
        else _copied(child, origin)
        for key, child in node.items()
    }


def _mapping(node: Mapping[str, Any], schema: Schema, depth: int, told: set[str]) -> Iterator[str]:
    """Lines of a mapping, each key under what is to be said of it; what is in `told` has been said and is not again."""
    for key, child in node.items():
        inner = schema["properties"].get(key)
        if not isinstance(inner, dict):
            inner = schema["additionalProperties"] if isinstance(schema.get("additionalProperties"), dict) else {}
        yield from (STEP * depth + line for line in _comment(inner, told))
        if _is_flat(child):
            yield f"{STEP * depth}{key}: {_flow(child)}"
        elif isinstance(child, dict):
            yield f"{STEP * depth}{key}:"
            yield from _mapping(child, inner, depth + 1, told)
        else:
            yield f"{STEP * depth}{key}:"
            for entry in child:
                lines = list(_mapping(entry, inner["items"], depth + 2, told))
                first = next(i for i, line in enumerate(lines) if not line.lstrip().startswith("#"))
                lines[first] = f"{STEP * (depth + 1)}- {lines[first].lstrip()}"
                yield from lines


def _comment(schema: Schema, told: set[str]) -> Iterator[str]:
    """What a key is, and what it may be."""
    text = schema.get("description", "")
    value = schema.get("properties", {}).get("value")
    if isinstance(value, dict):
        unit = schema["properties"]["unit"]["const"]
        text += f". Allowed: {allowed_values(value)}" + ("" if unit == "1" else f"; unit: {unit}")
    elif "enum" in schema:
        text += f". Allowed: {allowed_values(schema)}"
    if text and text not in told:
        told.add(text)
        yield from (f"# {line}" for line in wrap(text[0].upper() + text[1:] + ".", LINE))


def _is_flat(node: Any) -> bool:
    """Whether a node stands on one line: a scalar, a quantity, or a list of scalars."""
    if isinstance(node, dict):
        return "value" in node
    return not (isinstance(node, list) and any(isinstance(child, dict) for child in node))


def _flow(node: Any) -> str:
    """A node on a line, with texts that are no plain words in double quotes."""
    if isinstance(node, dict):
        return "{" + ", ".join(f"{key}: {_flow(child)}" for key, child in node.items()) + "}"
    if isinstance(node, list):
        return "[" + ", ".join(map(_flow, node)) + "]"
    if isinstance(node, str):
        return node if node.isidentifier() and yaml.safe_load(node) == node else json.dumps(node, ensure_ascii=False)
    return yaml.safe_dump(node).removesuffix("...\n").strip()
