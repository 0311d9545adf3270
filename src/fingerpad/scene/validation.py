"""Validation of scene files: one message that names file, key, what was found, what is allowed and what was meant.

The JSON Schemas say what is allowed and, in their descriptions, what each key is. What a schema cannot say
(actuators that overlap, layers that leave no bone) the scene itself refuses when it is built. Jobs of `all` read files
that have passed here; those that vary values (the ensemble, phases) ask again.
"""

from __future__ import annotations

import functools
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..csvrows import listed
from ..errors import SceneError, UsageError
from ..guess import closest
from .contact_law import Criterion
from .device_names import require_name
from .meant import decimal_comma, meant_by
from .problems import Problem, problem, report, shown, shown_name
from .scene import Model, Scene
from .scenefile import build_device, build_model, with_contact
from .schema import Schema, allowed_values, refusals, resolved
from .variation import NO_VALUES, shared_out, with_value
from .yamlfile import read_yaml

if TYPE_CHECKING:
    from jsonschema import ValidationError

Key = list[str | int]

# rank of a problem by the rule of the schema that is broken, else 2
PRECEDENCE: Mapping[str, int] = {"required": 0, "additionalProperties": 0, "type": 1}
SOURCE_RANK = 3  # of what is wrong with a source: values and units come first


def check_config(path: Path, schema_dir: Path, values: Mapping[str, Any] = NO_VALUES) -> Model:
    """The model of a config file that holds what `config.schema.yaml` allows. values: in place of those at some keys.

    Raises SceneError with up to MOST_REPORTED problems, a line each, the most fundamental first.

    >>> check_config(Path("config/config.yaml"), Path("workflow/schemas")).finger.width
    16.0
    """
    document, schema = checked_document(path, schema_dir / "config.schema.yaml", values)
    where = _named(path, values)
    report(where, _layer_problems(document))
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
    try:
        document, schema = checked_document(path, schema_dir / "device.schema.yaml", own)
    except SceneError:
        _require_no_model(path)
        raise
    with _located(_named(path, own), schema, "stimulus"):
        device = build_device(path, document)
    with _located(_named(path, values), schema, "actuators"):
        scene = Scene(with_contact(model, document), device)
    if not values:  # what is varied may end pre-indentation otherwise
        report(path, _idle_preloads(document, schema, scene.model.contact.criterion))
    return scene


def _require_no_model(path: Path) -> None:
    """Raise SceneError for a model in place of a device, as config.yaml is one, and what `read_yaml` raises."""
    document = read_yaml(path)
    if "finger" in document and "actuators" not in document:
        raise SceneError(f"{path}: found a model (finger, contact, ...); allowed: a device, as in config/devices")


def _idle_preloads(document: dict[str, Any], schema: Schema, criterion: Criterion) -> Iterator[Problem]:
    """Depth and force that a device's document has though pre-indentation ends at neither."""
    for key in (Criterion.DEPTH, Criterion.FORCE):
        if key in document.get("contact", {}) and criterion is not key:
            about = schema["properties"]["contact"]["properties"][key]["description"]
            found = f"a value without effect, as contact.criterion is {criterion}"
            yield problem(2, f"contact.{key}", found, f"one beside contact.criterion: {key}", about=about)


def possible(
    varied: Sequence[dict[str, Any]], checked: Callable[[Mapping[str, Any]], Scene]
) -> tuple[list[tuple[dict[str, Any], Scene]], list[str]]:
    """Combinations of values with their scenes, and why others have none, as a wide pin has none on a narrow pitch.

    checked: the scene with some values. Raises its SceneError if one of the values is in no combination that has a
    scene, and UsageError as `require_effect`.
    """
    found: list[tuple[dict[str, Any], Scene]] = []
    refused: list[tuple[dict[str, Any], SceneError]] = []
    for values in varied:
        try:
            found.append((values, checked(values)))
        except SceneError as error:
            refused.append((values, error))
    for values, why in refused:
        if not (found and all(any(value == others[key] for others, _ in found) for key, value in values.items())):
            raise why
    require_effect([values for values, _ in found], [scene for _, scene in found])
    return found, [str(why) for _, why in refused]


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
    schema = resolved(files[schema_path], document, files, schema_path)
    errors = refusals(schema, document)
    report(_named(path, values), (each for error in errors for each in _explain(error, schema, document)))
    return document, schema


def _named(path: Path, values: Mapping[str, Any]) -> str:
    """A file, and the values that take the place of its own."""
    return f"{path}{' with ' if values else ''}{', '.join(f'{key} {shown(value)}' for key, value in values.items())}"


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
    """Layers that share a name, and receptors under a layer, or a layer that relaxes, that there is not."""
    finger, above = config["finger"], config["readout"]["layer_above"]["value"]
    names = {f"finger.{side}[{i}].name": la["name"] for side in ("pad", "dorsal") for i, la in enumerate(finger[side])}
    for key, name in names.items():
        if (times := [*names.values()].count(name)) > 1:
            yield problem(2, key, f"{name} {times} times", "each name once", about="name of the layer")
    inner = [layer["name"] for layer in finger["pad"][:-1]]
    if above not in inner:
        allowed, about = f"one of {', '.join(inner)}", "the pad layer above the receptor line, so not the last one"
        yield problem(2, "readout.layer_above.value", above, allowed, meant=closest(above, inner), about=about)
    every, relaxing = list(names.values()), config["vibration"]["layers"]["value"]
    for number, name in enumerate(relaxing):
        if name not in every:
            key, allowed = f"vibration.layers.value[{number}]", f"one of {', '.join(every)}"
            yield problem(2, key, name, allowed, meant=closest(name, every), about="a layer that relaxes")


def _explain(error: ValidationError, schema: Schema, document: dict[str, Any]) -> Iterator[Problem]:
    """The problems, in words, that lie behind one error of the schema."""
    key, found, rank = list(error.absolute_path), error.instance, PRECEDENCE.get(error.validator, 2)
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
    around = functools.reduce(operator.getitem, key[:-1], document)
    if rank == 1 and error.schema["type"] == "array" and isinstance(around, list) and not any(map(_is_list, around)):
        yield problem(rank, _dotted(key[:-1]), shown(around), "a list of lists", meant=shown([around]), about=about)
        return
    text = f"{len(found)} entries" if error.validator in ("minItems", "maxItems") else shown(found)
    if "propertyNames" in error.absolute_schema_path:
        rank, text = 0, f"the name {shown_name(found)}"
    meant = meant_by(error.schema, found, around)
    yield problem(rank, _dotted(key), text, allowed_values(error.schema), meant=meant, about=about)


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
            return problem(0, _dotted(key[:place]), what, "these under a name", meant="NAME: {...}", about=about)
        known = schema["properties"].get(step, inner)
        if place == len(key) or not isinstance(known, dict):
            return None
        found, schema = found[step], known
    return None


def _is_list(found: Any) -> bool:
    return isinstance(found, list)


def _is_one(found: Any, schema: Any) -> bool:
    """Whether a value is a mapping with keys of a schema alone."""
    return isinstance(found, dict) and bool(found) and found.keys() <= schema["properties"].keys()


def _key_problems(schema: Schema, key: Key, found: dict[str, Any], about: str) -> Iterator[Problem]:
    """Unknown and missing keys of a mapping; a misspelled one is both, and reported once, as unknown."""
    named, open_ = schema["properties"], schema.get("additionalProperties") is not False
    missing = [name for name in schema["required"] if name not in found]
    if "value" in named and (comma := decimal_comma(found, named["value"])):
        yield problem(0, _dotted([*key, "value"]), "a decimal comma", "a decimal point", meant=comma, about=about)
        return
    unknown = {name: closest(name, (n for n in named if n not in found)) for name in found if name not in named}
    for name, meant in unknown.items():
        if meant or not open_:
            allowed, what = f"the keys {', '.join(named)}", named.get(meant, {}).get("description", about)
            yield problem(0, _dotted([*key, name]), "an unknown key", allowed, meant=meant, about=what)
    for name in missing:
        if name not in unknown.values():
            what = named[name].get("description", about)
            yield problem(0, _dotted([*key, name]), "nothing", allowed_values(named[name]), about=what)


def _dotted(key: Key) -> str:
    """A key as it is spoken of: `finger.pad[2].modulus`."""
    steps = (f"[{step}]" if isinstance(step, int) else f".{shown_name(step)}" for step in key)
    return "".join(steps).removeprefix(".")
