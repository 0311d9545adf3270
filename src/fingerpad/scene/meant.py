"""What was probably meant by a wrong value, unit or key."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from contextlib import suppress
from decimal import Decimal
from typing import Any

from ..guess import TYPED, closest
from ..requirements import is_number
from .problems import shown

# source: tables that are read with pandas take them for missing, and columns of nothing else for numbers and truths
RESERVED = {"false", "inf", "infinity", "nan", "null", "true"}
QUOTES = "\"'\N{LEFT DOUBLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}\N{DOUBLE LOW-9 QUOTATION MARK}"
FACTORS: Mapping[tuple[str, str], float] = {
    **{("mm", unit): 1e-3 for unit in ("um", "\N{GREEK SMALL LETTER MU}m", "\N{MICRO SIGN}m")},
    **{("mm", "nm"): 1e-6, ("mm", "cm"): 10.0, ("mm", "m"): 1e3},
    **{("MPa", "Pa"): 1e-6, ("MPa", "kPa"): 1e-3, ("MPa", "GPa"): 1e3},
    **{("deg", "rad"): 180.0 / math.pi, ("s", "ms"): 1e-3, ("1", "%"): 1e-2},
}


def meant_by(schema: Mapping[str, Any], found: Any, quantity: Any) -> str:
    """What was probably meant by a wrong value (for a unit: by that of the quantity), or nothing."""
    kind, unit = schema.get("type"), schema["properties"].get("unit", {}).get("const")
    if "const" in schema:
        return _meant_unit(schema["const"], found, quantity)
    if "enum" in schema:
        return closest(found, schema["enum"])
    if unit and isinstance(found, str | int | float | list):
        value = _meant_value(schema["properties"]["value"], found, unit)
        return f"{{value: {value}, unit: {shown(unit)}, source: ...}}"
    if kind == "number":
        return _meant_number(schema, found, quantity.get("unit") if isinstance(quantity, dict) else None)
    if kind in ("integer", "boolean", "array"):
        return _meant_type(schema, found)
    return as_name(found) if schema.get("format") == "name" else ""


def _meant_unit(unit: str, found: Any, quantity: Any) -> str:
    """The unit in its own letters, or as the text that it is, or the quantity in that unit; or nothing."""
    if type(found) is int and str(found) == unit:
        return f'"{unit}" in quotes'
    if isinstance(found, str) and (plain := found.strip(QUOTES).lower()) == unit.lower():
        return f'"{unit}" in quotes' if plain.isdecimal() else unit
    value = _scaled(quantity.get("value"), FACTORS.get((unit, str(found)), math.nan))
    return "" if value is None else f"{{value: {shown(value)}, unit: {unit}}}"


def _meant_number(schema: Mapping[str, Any], found: Any, unit: Any) -> str:
    """What was probably meant by a text for a number (0,6 or 16 mm), or by micrometres or metres that are called mm; or
    nothing.
    """
    if isinstance(found, str):
        with suppress(ValueError):
            value = float(found.removesuffix(str(unit)).translate(TYPED))
            return shown(value) if math.isfinite(value) else ""
    if unit != "mm" or not is_number(found):
        return ""
    lowest, highest = float(schema.get("minimum", 0.0)), float(schema.get("maximum", math.inf))
    meant = _scaled(found, FACTORS["mm", "um" if found > highest else "m"])
    return f"{{value: {shown(meant)}, unit: mm}}" if meant and lowest <= meant <= highest else ""


def _meant_value(schema: Mapping[str, Any], found: Any, unit: str) -> str:
    """The value of a quantity for which a value alone was found: where it must be a number, it or the one in a text."""
    kind = schema.get("type")
    if kind not in ("number", "integer"):
        return shown(found)
    if not isinstance(found, str):
        return shown(found) if is_number(found) else "..."
    return _meant_number(schema, found, unit).removesuffix(".0" if kind == "integer" else "") or "..."


def _meant_type(schema: Mapping[str, Any], found: Any) -> str:
    """The value of a schema's type which was probably meant by one of another, or nothing."""
    kind = schema["type"]
    if kind == "integer" and isinstance(found, float) and found.is_integer():
        return shown(int(found))
    if kind == "boolean" and isinstance(found, str):
        return {"yes": "true", "on": "true", "no": "false", "off": "false"}.get(found.lower(), "")
    if kind == "array" and is_number(found):
        return shown([[found]] if schema["items"].get("type") == "array" else [found])
    return ""


def decimal_comma(found: Mapping[Any, Any], allowed: Mapping[str, Any]) -> str:
    """The number that was meant by {value: 0,6, ...}, which is a value 0 and a key 6 without a value; or nothing.

    YAML reads -0 as 0, so of -0,6 the sign is lost: where numbers below zero are allowed, both are named.
    """
    whole = found.get("value")
    parts = [name for name, value in found.items() if str(name).isdecimal() and value is None]
    if type(whole) is not int or len(parts) != 1:
        return ""
    lowest = [allowed[key] for key in ("minimum", "exclusiveMinimum") if key in allowed]
    meant = f"{whole}.{parts[0]}"
    return f"{meant} or -{meant}" if whole == 0 and min(lowest, default=0.0) < 0.0 else meant


def _scaled(value: Any, factor: float) -> Any:
    """A number, or a list of numbers, times a factor, to the digits that it has; None if that cannot be."""
    if isinstance(value, list):
        scaled = [_scaled(entry, factor) for entry in value]
        return None if None in scaled else scaled
    if not (is_number(value) and is_number(factor)):
        return None
    digits = len(Decimal(str(value)).normalize().as_tuple().digits)
    return float(f"{value * factor:.{digits}g}")


def as_name(text: object) -> str:
    """The name that comes nearest to a text that is none, or nothing."""
    if isinstance(text, bool):
        return f'"{str(text).lower()}" in quotes'
    plain = re.sub("[\u0300-\u036f]", "", unicodedata.normalize("NFKD", str(text)))  # without accents
    if not plain.isascii():
        return ""
    name = re.sub("[^a-z0-9]+", "_", plain.lower()).strip("_").lstrip("0123456789_")
    return name if name != text and name not in RESERVED else ""
