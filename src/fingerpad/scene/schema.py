"""Schemas of scene files: with their references resolved, and in words."""

from __future__ import annotations

import functools
import operator
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ..imports import without
from ..requirements import is_number
from .problems import shown
from .yamlfile import read_yaml

with without("rfc3987_syntax"):  # a checker of web addresses, which scenes do not hold; compiling it takes seconds
    from jsonschema import Draft202012Validator, ValidationError, validators

Schema = dict[str, Any]

WORDS: Mapping[str, str] = {
    **{"object": "a mapping", "array": "a list", "string": "text"},
    **{"number": "a finite number", "integer": "a whole number", "boolean": "true or false"},
    **{"minimum": ">= {}", "exclusiveMinimum": "> {}", "maximum": "<= {}", "exclusiveMaximum": "< {}"},
    **{"minItems": "at least {} long", "maxItems": "at most {} long", "uniqueItems": "without repeats"},
    **{"minLength": "at least {} long", "maxLength": "at most {} characters", "minProperties": "at least {} long"},
}


def refusals(schema: Schema, document: Any) -> Iterator[ValidationError]:
    """What a schema, its references resolved, does not allow in a document."""
    checker = Draft202012Validator.TYPE_CHECKER.redefine("number", lambda _, value: is_number(value)).redefine(
        "integer", lambda _, value: is_number(value) and isinstance(value, int)
    )
    validator = validators.extend(Draft202012Validator, type_checker=checker)
    yield from validator(schema).iter_errors(document)


def allowed_values(schema: Schema) -> str:
    """What a schema, its references resolved, allows, in words."""
    if "title" in schema or "const" in schema:
        return str(schema.get("title") or shown(schema["const"]))
    if "enum" in schema:
        return f"one of {', '.join(schema['enum'])}"
    words = [WORDS[schema["type"]], *(WORDS[key].format(limit) for key, limit in schema.items() if key in WORDS)]
    return ", ".join(words) + (f" with the keys {', '.join(schema['required'])}" if schema["required"] else "")


def _referred(reference: str, files: dict[Path, Schema], own: Path) -> tuple[Schema, Path]:
    """The part of a schema that a reference in the file `own` points to, and the file that holds it. files: those that
    have been read, to which it is added.

    >>> _referred("#/$defs/name", {Path("a"): {"$defs": {"name": {"type": "string"}}}}, Path("a"))[0]
    {'type': 'string'}
    """
    name, _, place = reference.partition("#/")
    file = own.with_name(name) if name else own
    if file not in files:
        files[file] = read_yaml(file)
    found: Schema = functools.reduce(operator.getitem, place.split("/"), files[file])
    return found, file


def resolved(schema: Schema, value: Any, files: dict[Path, Schema], own: Path) -> Schema:
    """The schema with references replaced and, of its if-then branches, those alone that hold for the value. files: the
    schemas that have been read. own: the one that it is a part of.

    So every error comes with all that is said about its key, and with nothing about kinds that were not chosen.
    """
    parts = [_referred(schema["$ref"], files, own)] if "$ref" in schema else []
    given = {} if value is None else value  # a mapping that is not there lacks what an empty one does
    cases = schema.get("allOf", []) if isinstance(given, dict) else []
    parts += [(case["then"], own) for case in cases if Draft202012Validator(case["if"]).is_valid(given)]
    rest = {keyword: content for keyword, content in schema.items() if keyword not in ("$ref", "allOf")}
    plain: Schema = {"properties": {}, "required": []}
    for part in (*(resolved(part, value, files, file) for part, file in parts), rest):
        properties = plain["properties"] | part.get("properties", {})
        required = [*part.get("required", []), *plain["required"]]
        plain = plain | part | {"properties": properties, "required": required}
    inner = value if isinstance(value, dict) else {}
    children = {name: child for name, child in plain["properties"].items() if isinstance(child, dict)}
    plain["properties"] |= {name: resolved(child, inner.get(name), files, own) for name, child in children.items()}
    for keyword in ("items", "additionalProperties", "propertyNames"):
        if isinstance(plain.get(keyword), dict):
            plain[keyword] = resolved(plain[keyword], None, files, own)
    return plain
