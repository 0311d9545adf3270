"""Validation of scene files: one message that names file, key, what was found, what is allowed and what was meant.

The JSON Schemas say what is allowed and, in their descriptions, what each key is. What a schema cannot say
(actuators that overlap, layers that leave no bone) the scene itself refuses when it is built. Solver jobs read files
that have passed here and never import this module.
"""

from __future__ import annotations

import difflib
import functools
import math
import operator
import re
import sys
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from decimal import Decimal
from pathlib import Path
from typing import Any

import yaml

from ..csvrows import listed
from ..errors import SceneError, UsageError
from ..guess import hint
from ..imports import without
from .contact_law import Criterion
from .scene import Model, Scene
from .scenefile import build_device, build_model, read_yaml, with_contact
from .variation import NO_VALUES, shared_out, with_value

with without("rfc3987_syntax"):  # a checker of web addresses, which scenes do not hold; compiling it takes seconds
    from jsonschema import Draft202012Validator, ValidationError, validators

Schema = dict[str, Any]
Key = list[str | int]
Problem = tuple[int, str]  # how fundamental (0 is the most), and the line that begins with its key

MOST_REPORTED = 5  # problems in one message [1]
LONGEST_NAME = 64  # characters of a device's name [1]; source: as in the schemas
# source: tables that are read with pandas take them for missing, and columns of nothing else for numbers and truths
RESERVED = {"false", "inf", "infinity", "nan", "null", "true"}
NAME = f"small letters, digits and underscores that begin with a letter, at most {LONGEST_NAME}"
YAML_ENDINGS = {".yaml", ".yml"}
LONGEST_SHOWN = 60  # characters of a found value in a message [1]
SIMILAR = 0.7  # likeness of words [1] above which one is taken for the other (difflib's); source: chosen
FACTORS: Mapping[tuple[str, str], float] = {
    **{("mm", unit): 1e-3 for unit in ("um", "\N{GREEK SMALL LETTER MU}m", "\N{MICRO SIGN}m")},
    **{("mm", "nm"): 1e-6, ("mm", "cm"): 10.0, ("mm", "m"): 1e3},
    **{("MPa", "Pa"): 1e-6, ("MPa", "kPa"): 1e-3, ("MPa", "GPa"): 1e3},
    **{("deg", "rad"): 180.0 / math.pi, ("s", "ms"): 1e-3, ("1", "%"): 1e-2},
}
WORDS: Mapping[str, str] = {
    **{"object": "a mapping", "array": "a list", "string": "text"},
    **{"number": "a finite number", "integer": "a whole number", "boolean": "true or false"},
    **{"minimum": ">= {}", "exclusiveMinimum": "> {}", "maximum": "<= {}", "exclusiveMaximum": "< {}"},
    **{"minItems": "at least {} long", "maxItems": "at most {} long", "uniqueItems": "without repeats"},
    **{"minLength": "at least {} long", "maxLength": "at most {} characters", "minProperties": "at least {} long"},
}
RANKS: Mapping[str, int] = {"required": 0, "additionalProperties": 0, "type": 1}  # else 2
SOURCE_RANK = 3  # of what is wrong with a source: values and units come first


def check_config(path: Path, schema_dir: Path, values: Mapping[str, Any] = NO_VALUES) -> Model:
    """The model of a config file that holds what `config.schema.yaml` allows. values: in place of those at some keys.

    Raises SceneError with up to MOST_REPORTED problems, a line each, the most fundamental first.

    >>> check_config(Path("config/config.yaml"), Path("workflow/schemas")).finger.width
    16.0
    """
    document, schema = checked_document(path, schema_dir / "config.schema.yaml", values)
    where = _named(path, values)
    _report(where, _layer_problems(document))
    with _located(where, schema, "finger"):
        return build_model(document)


def check_device(path: Path, schema_dir: Path, config_path: Path, values: Mapping[str, Any] = NO_VALUES) -> Scene:
    """The scene of a device file that holds what `device.schema.yaml` allows, and of a config file that it fits.
    values: in place of those at some keys of either file.

    Raises SceneError as `check_config` does, about the config file if that one is wrong.

    >>> config = Path("config/config.yaml")
    >>> check_device(Path("config/devices/device2.yaml"), Path("workflow/schemas"), config).device.name
    'device2'
    """
    own, of_model = values, values
    if values:
        check_device(path, schema_dir, config_path)  # files are right as they stand before anything in them is varied
        own, of_model = shared_out(values, {each: read_yaml(each) for each in (path, config_path)}).values()
    model = check_config(config_path, schema_dir, of_model)
    require_name(path)
    document, schema = checked_document(path, schema_dir / "device.schema.yaml", own)
    where = _named(path, own)
    with _located(where, schema, "stimulus"):
        device = build_device(path, document)
    with _located(where, schema, "actuators"):
        scene = Scene(with_contact(model, document), device)
    if not values:  # what is varied may end pre-indentation otherwise
        _report(where, _idle_preloads(document, schema, scene.model.contact.criterion))
    return scene


def _idle_preloads(document: dict[str, Any], schema: Schema, criterion: Criterion) -> Iterator[Problem]:
    """Depth and force that a device's document has though pre-indentation ends at neither."""
    for key in (Criterion.DEPTH, Criterion.FORCE):
        if key in document.get("contact", {}) and criterion is not key:
            about = schema["properties"]["contact"]["properties"][key]["description"]
            found = f"a value without effect, as contact.criterion is {criterion}"
            yield _problem(2, f"contact.{key}", found, f"one beside contact.criterion: {key}", about=about)


def require_effect(varied: Sequence[Mapping[str, Any]], scenes: Sequence[Scene]) -> None:
    """Raise UsageError if a depth or a force is varied where pre-indentation ends at neither."""
    criteria = {scene.model.contact.criterion for scene in scenes}
    for criterion in (Criterion.DEPTH, Criterion.FORCE):
        key = f"contact.{criterion}"
        if criterion not in criteria and any(key in values for values in varied):
            raise UsageError(
                f"vary: found {key}, which has no effect where contact.criterion is {listed(sorted(criteria))};"
                f" vary contact.criterion, too: {criterion}"
            )


def known_devices(folder: Path) -> list[str]:
    """The names of the devices in a folder: the stems of its YAML files, sorted. Hidden files are left out.

    Raises SceneError if there is no such folder, or if a file's name cannot be a device's.

    >>> known_devices(Path("config/devices"))
    ['device1', 'device2', 'device3']
    """
    if not folder.is_dir():
        raise SceneError(f"{folder}: is not a folder; it should hold one YAML file for each device")
    files = [p for p in folder.iterdir() if p.suffix.lower() in YAML_ENDINGS and not p.name.startswith(".")]
    for path in sorted(files):
        require_name(path)
    return sorted(path.stem for path in files)


def require_device(name: str, folder: Path) -> Path:
    """The file of a device. Raises SceneError that names the known devices if there is none of that name."""
    known = known_devices(folder)
    if name not in known:
        allowed, meant = ", ".join(known) or "none, as there is no file yet", _closest(name, known)
        found = f"{shown(name)}, which has no file"
        _report(
            folder, [_problem(0, "device", found, allowed, meant=meant, about="a device's file name without .yaml")]
        )
    return folder / f"{name}.yaml"


def _is_name(text: str) -> bool:
    """Whether that may be a device's name."""
    return bool(re.fullmatch("[a-z][a-z0-9_]*", text)) and len(text) <= LONGEST_NAME and text not in RESERVED


def _allowed_name(found: str) -> str:
    """What may be a device's name, where what was found may not."""
    return f"a name other than {', '.join(sorted(RESERVED))}" if found in RESERVED else NAME


def require_name(path: Path) -> None:
    """Raise SceneError for a device file whose name cannot be part of other files' names."""
    fits = _is_name(path.stem)
    if not fits or path.suffix != ".yaml":
        allowed = f"{_allowed_name(path.stem)}, then .yaml"
        meant = path.stem if fits else _as_name(path.stem)
        file = f"{meant}.yaml" if meant and path.suffix.lower() in YAML_ENDINGS else ""
        about = "the file name is the device's name"
        _report(path, [_problem(0, "file name", _shown_name(path.name), allowed, meant=file, about=about)])


def require_new_name(name: str) -> None:
    """Raise SceneError for what cannot be the name of a new device."""
    if not _is_name(name):
        stem, about = name.removesuffix(".yaml"), "name of a device, and of its file without .yaml"
        meant = _as_name(stem) or (stem if stem.isidentifier() and stem.isascii() and stem != name else "")
        raise SceneError(_problem(0, "NAME", _shown_name(name), _allowed_name(stem), meant=meant, about=about)[1])


def checked_document(
    path: Path, schema_path: Path, values: Mapping[str, Any] = NO_VALUES
) -> tuple[dict[str, Any], Schema]:
    """The mapping in a file, with some values in place of its own, after it has passed the schema, and the schema.

    Raises SceneError as `read_yaml`, and with all that the schema does not allow.
    """
    document = read_yaml(path)
    for key, value in values.items():
        document = with_value(document, key, value, "varied")
    files = {schema_path: read_yaml(schema_path)}
    schema = _plain(files[schema_path], document, files, schema_path)
    checker = Draft202012Validator.TYPE_CHECKER.redefine("number", lambda _, value: is_number(value)).redefine(
        "integer", lambda _, value: is_number(value) and isinstance(value, int)
    )
    errors = validators.extend(Draft202012Validator, type_checker=checker)(schema).iter_errors(document)
    _report(_named(path, values), (problem for error in errors for problem in _explain(error, schema, document)))
    return document, schema


def allowed_values(schema: Schema) -> str:
    """What a schema, its references resolved, allows, in words."""
    if "title" in schema or "const" in schema:
        return str(schema.get("title") or shown(schema["const"]))
    if "enum" in schema:
        return f"one of {', '.join(schema['enum'])}"
    words = [WORDS[schema["type"]], *(WORDS[key].format(limit) for key, limit in schema.items() if key in WORDS)]
    return ", ".join(words) + (f" with the keys {', '.join(schema['required'])}" if schema["required"] else "")


def _problem(rank: int, key: str, found: str, allowed: str, *, about: str, meant: str = "") -> Problem:
    return rank, f"{key}: found {found}; allowed: {allowed}{hint(meant)} ({about})"


def _named(path: Path, values: Mapping[str, Any]) -> str:
    """A file, and the values that take the place of its own."""
    return f"{path}{' with ' if values else ''}{', '.join(f'{key} {shown(value)}' for key, value in values.items())}"


def _report(path: object, problems: Iterable[Problem]) -> None:
    """Raise the first few problems, if there are any, as one SceneError."""
    ordered = sorted(set(problems))  # by key within a rank: jsonschema has no fixed order
    lines = [f"{path}: {line}" for _, line in ordered[:MOST_REPORTED]]
    if len(ordered) > MOST_REPORTED:
        lines.append(f"{path}: and {len(ordered) - MOST_REPORTED} more")
    if lines:
        raise SceneError("\n".join(lines))


@contextmanager
def _located(path: object, schema: Schema, key: str) -> Iterator[None]:
    """Complete a SceneError of the scene itself: with the file, the key unless it begins with one, and what that is."""
    try:
        yield
    except SceneError as error:
        first, message = re.split(r"\W", str(error))[0], str(error)
        if first not in schema["properties"]:
            first, message = key, f"{key}: {message}"
        raise SceneError(f"{path}: {message} ({schema['properties'][first]['description']})") from error


def _layer_problems(config: Mapping[str, Any]) -> Iterator[Problem]:
    """Layers that share a name, and receptors under a layer that there is not."""
    finger, above = config["finger"], config["readout"]["layer_above"]["value"]
    names = {f"finger.{side}[{i}].name": la["name"] for side in ("pad", "dorsal") for i, la in enumerate(finger[side])}
    for key, name in names.items():
        if (times := [*names.values()].count(name)) > 1:
            yield _problem(2, key, f"{name} {times} times", "each name once", about="name of the layer")
    inner = [layer["name"] for layer in finger["pad"][:-1]]
    if above not in inner:
        allowed, about = f"one of {', '.join(inner)}", "the pad layer above the receptor line, so not the last one"
        yield _problem(2, "readout.layer_above.value", above, allowed, meant=_closest(above, inner), about=about)


def is_number(value: Any) -> bool:
    """Whether it is a finite number; JSON Schema alone lets NaN and infinity through."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


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


def _plain(schema: Schema, value: Any, files: dict[Path, Schema], own: Path) -> Schema:
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
    for part in (*(_plain(part, value, files, file) for part, file in parts), rest):
        properties = plain["properties"] | part.get("properties", {})
        required = [*part.get("required", []), *plain["required"]]
        plain = plain | part | {"properties": properties, "required": required}
    inner = value if isinstance(value, dict) else {}
    children = {name: child for name, child in plain["properties"].items() if isinstance(child, dict)}
    plain["properties"] |= {name: _plain(child, inner.get(name), files, own) for name, child in children.items()}
    for keyword in ("items", "additionalProperties", "propertyNames"):
        if isinstance(plain.get(keyword), dict):
            plain[keyword] = _plain(plain[keyword], None, files, own)
    return plain


def _explain(error: ValidationError, schema: Schema, document: dict[str, Any]) -> Iterator[Problem]:
    """The problems, in words, that lie behind one error of the schema."""
    key, found, rank = list(error.absolute_path), error.instance, RANKS.get(error.validator, 2)
    if key and key[-1] == "source":
        rank = SOURCE_RANK
    if (nameless := _nameless(key, schema, document)) is not None:
        yield nameless
        return
    about = schema["description"]  # the nearest description on the way to the key
    for step in error.absolute_schema_path:
        schema = schema[step]
        about = schema.get("description", about) if isinstance(schema, dict) else about
    if rank == 0:
        yield from _key_problems(error.schema, key, found, about)
        return
    text = f"{len(found)} entries" if error.validator in ("minItems", "maxItems") else shown(found)
    text = f"the name {text}" if "propertyNames" in error.absolute_schema_path else text
    meant = _meant(error.schema, found, functools.reduce(operator.getitem, key[:-1], document))
    yield _problem(rank, _dotted(key), text, allowed_values(error.schema), meant=meant, about=about)


def _nameless(key: Key, schema: Schema, document: dict[str, Any]) -> Problem | None:
    """The problem that on the way to a key what belongs under a name stands without one."""
    found: Any = document
    for place, step in enumerate([*key, ""]):
        inner = schema.get("items" if isinstance(step, int) else "additionalProperties")
        if (
            "propertyNames" in schema
            and _is_one(found, inner)
            and not any(_is_one(each, inner) for each in found.values())
        ):
            what, about = f"{', '.join(found)} without a name", schema["description"]
            return _problem(0, _dotted(key[:place]), what, "these under a name", meant="NAME: {...}", about=about)
        known = schema["properties"].get(step, inner)
        if place == len(key) or not isinstance(known, dict):
            return None
        found, schema = found[step], known
    return None


def _is_one(found: Any, schema: Any) -> bool:
    """Whether a value is a mapping with keys of a schema alone."""
    return isinstance(found, dict) and bool(found) and found.keys() <= schema["properties"].keys()


def _key_problems(schema: Schema, key: Key, found: dict[str, Any], about: str) -> Iterator[Problem]:
    """Unknown and missing keys of a mapping; a misspelled one is both, and reported once, as unknown."""
    named, open_ = schema["properties"], schema.get("additionalProperties") is not False
    missing = [name for name in schema["required"] if name not in found]
    if "value" in named and (comma := _decimal_comma(found, named["value"])):
        yield _problem(0, _dotted([*key, "value"]), "a decimal comma", "a decimal point", meant=comma, about=about)
        return
    unknown = {name: _closest(name, (n for n in named if n not in found)) for name in found if name not in named}
    for name, meant in unknown.items():
        if meant or not open_:
            allowed, what = f"the keys {', '.join(named)}", named.get(meant, {}).get("description", about)
            yield _problem(0, _dotted([*key, name]), "an unknown key", allowed, meant=meant, about=what)
    for name in missing:
        if name not in unknown.values():
            what = named[name].get("description", about)
            yield _problem(0, _dotted([*key, name]), "nothing", allowed_values(named[name]), about=what)


def _meant(schema: Schema, found: Any, quantity: Any) -> str:
    """What was probably meant by a wrong value (for a unit: by that of the quantity), or nothing."""
    kind, unit = schema.get("type"), schema["properties"].get("unit", {}).get("const")
    if "const" in schema:
        return _meant_unit(schema["const"], found, quantity)
    if "enum" in schema:
        return _closest(found, schema["enum"])
    if unit and isinstance(found, str | int | float | list):
        value = _meant_value(schema["properties"]["value"], found, unit)
        return f"{{value: {value}, unit: {shown(unit)}, source: ...}}"
    if kind == "number":
        return _meant_number(schema, found, quantity.get("unit") if isinstance(quantity, dict) else None)
    if kind in ("integer", "boolean", "array"):
        return _meant_type(kind, found)
    return _as_name(found) if schema.get("format") == "name" else ""


def _meant_unit(unit: str, found: Any, quantity: Any) -> str:
    """The unit in its own letters, or as the text that it is, or the quantity in that unit; or nothing."""
    if type(found) is int and str(found) == unit:
        return f'"{unit}" in quotes'
    if isinstance(found, str) and found.lower() == unit.lower():
        return unit
    value = _scaled(quantity.get("value"), FACTORS.get((unit, str(found)), math.nan))
    return "" if value is None else f"{{value: {shown(value)}, unit: {unit}}}"


def _meant_number(schema: Schema, found: Any, unit: Any) -> str:
    """What was probably meant by a text for a number (0,6 or 16 mm), or by micrometres or metres that are called mm; or
    nothing.
    """
    if isinstance(found, str):
        with suppress(ValueError):
            value = float(found.removesuffix(str(unit)).replace(",", "."))
            return shown(value) if math.isfinite(value) else ""
    if unit != "mm" or not is_number(found):
        return ""
    lowest, highest = float(schema.get("minimum", 0.0)), float(schema.get("maximum", math.inf))
    meant = _scaled(found, FACTORS["mm", "um" if found > highest else "m"])
    return f"{{value: {shown(meant)}, unit: mm}}" if meant and lowest <= meant <= highest else ""


def _meant_value(schema: Schema, found: Any, unit: str) -> str:
    """The value of a quantity for which a value alone was found: where it must be a number, it or the one in a text."""
    kind = schema.get("type")
    if kind not in ("number", "integer"):
        return shown(found)
    if not isinstance(found, str):
        return shown(found) if is_number(found) else "..."
    return _meant_number(schema, found, unit).removesuffix(".0" if kind == "integer" else "") or "..."


def _meant_type(kind: str, found: Any) -> str:
    """The value of that type which was probably meant by one of another, or nothing."""
    if kind == "integer" and isinstance(found, float) and found.is_integer():
        return shown(int(found))
    if kind == "boolean" and isinstance(found, str):
        return {"yes": "true", "on": "true", "no": "false", "off": "false"}.get(found.lower(), "")
    return f"[{shown(found)}]" if kind == "array" and is_number(found) else ""


def _decimal_comma(found: Mapping[Any, Any], allowed: Schema) -> str:
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


def _closest(word: object, known: Iterable[str]) -> str:
    """The known word that contains a word or else is most similar to it, or nothing."""
    text, words = str(word).lower(), list(known)
    longer = [word for word in words if len(text) > 3 and text in word]
    return next(iter(longer or difflib.get_close_matches(text, words, 1, SIMILAR)), "")


def _as_name(text: object) -> str:
    """The name that comes nearest to a text that is none, or nothing."""
    if isinstance(text, bool):
        return f'"{str(text).lower()}" in quotes'
    plain = re.sub("[\u0300-\u036f]", "", unicodedata.normalize("NFKD", str(text)))  # without accents
    if not plain.isascii():
        return ""
    name = re.sub("[^a-z0-9]+", "_", plain.lower()).strip("_").lstrip("0123456789_")
    return name if name != text and name not in RESERVED else ""


def _dotted(key: Key) -> str:
    """A key as it is spoken of: `finger.pad[2].modulus`."""
    steps = (f"[{step}]" if isinstance(step, int) else f".{_shown_name(step)}" for step in key)
    return "".join(steps).removeprefix(".")


def _shown_name(name: object) -> str:
    """A name on one line, in quotes and with codes of its letters if some are look-alikes or cannot be seen."""
    text = str(name)
    return text if text.isascii() and text.isprintable() and text else ascii(text)


def written(value: object) -> str:
    """A value as YAML would write it, on one line."""
    text = yaml.safe_dump(value, default_flow_style=True, allow_unicode=True, width=sys.maxsize)
    return " ".join(text.removesuffix("...\n").split())


def shown(value: object) -> str:
    """A value in a message: as YAML would write it, cut if it is long."""
    text = written(value)
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ..."
