"""What assumptions might be as well: scene files with one of them varied, in either half-cycle of the stimuli.

Every member of the ensemble is a folder of scene files in which what is varied says so as its source.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from ..errors import SceneError
from ..files import write_text
from ..guess import closest, hint
from ..requirements import is_number
from ..scene.sources import Origin
from ..scene.variation import Document, by_number, no_such_value, quantities_of, with_value
from ..scene.yamlfile import read_yaml

AS_CONFIGURED = "as configured"
FIRST, SECOND = "first", "second"
HALF_CYCLES = (FIRST, SECOND)
HALF_CYCLE = "stimulus.half_cycle"
PARTS = ("model", "devices")


@dataclass(frozen=True)
class Alternative:
    """What an assumption might be as well: a value that takes the place of the one at a key, or a factor [1] on it."""

    part: str
    key: str
    value: Any
    times: float | None
    source: str

    @property
    def name(self) -> str:
        """What is varied, in words.

        >>> Alternative("devices", "actuators.pitch", None, 0.8, "assumption: denser").name
        'actuators.pitch times 0.8'
        """
        return f"{self.key} {self.value}" if self.times is None else f"{self.key} times {self.times:g}"

    def instead_of(self, value: Any) -> Any:
        """What takes the place of a value; of a whole number a whole one, where the factor leaves it whole. Raises
        SceneError if a factor is to multiply what is no number.
        """
        if self.times is None:
            return self.value
        if not is_number(value):
            raise SceneError(f"ensemble: {self.key}: found {value!r}; allowed: a number, as `times` multiplies it")
        product = float(f"{value * self.times:.12g}")
        return int(product) if isinstance(value, int) and product.is_integer() else product


@dataclass(frozen=True)
class Scenes:
    """Scene files of a member: config.yaml's document, and those of the devices that it varies, by name."""

    config: Document
    devices: Mapping[str, Document]


def by_key(names: Iterable[str]) -> str:
    """Names of members, "key value" each, with the values of one key together.

    >>> by_key(["contact.friction 0.2", "finger.width 20.0", "contact.friction 0.38"])
    'contact.friction 0.2, 0.38; finger.width 20.0'
    """
    values: dict[str, list[str]] = {}
    for name in names:
        key, _, value = name.partition(" ")
        values.setdefault(key, []).append(value)
    return "; ".join(f"{key} {', '.join(each)}" for key, each in values.items())


def slug(name: str) -> str:
    """A name as a part of file names.

    >>> slug("contact.friction 0.38")
    'contact_friction_0_38'
    >>> slug("actuators.offset -0.5")
    'actuators_offset_minus_0_5'
    """
    return re.sub("[^a-z0-9]+", "_", name.lower().replace(" -", " minus ")).strip("_")


def read_ensemble(path: Path) -> list[Alternative]:
    """The alternatives in a file, in its order.

    Raises SceneError if it holds anything but lists of key, values or times, and source under PARTS, or if members
    would have one file name.
    """
    document = read_yaml(path)
    if unknown := [key for key in document if key not in PARTS]:
        raise SceneError(f"{path}: found the key {unknown[0]}; allowed: {', '.join(PARTS)}")
    found: list[Alternative] = []
    for part, entries in document.items():
        for number, entry in enumerate(entries if isinstance(entries, list) else [entries]):
            where = f"{path}: {part}[{number}]"
            if not isinstance(entry, dict) or entry.keys() not in (
                {"key", "values", "source"},
                {"key", "times", "source"},
            ):
                raise SceneError(f"{where}: found {entry!r:.60}; allowed: the keys key, values or times, and source")
            choices = entry.get("values", entry.get("times"))
            if not isinstance(choices, list) or not choices or ("times" in entry and not all(map(is_number, choices))):
                raise SceneError(f"{where}: found {choices!r:.60}; allowed: a list of one or more, numbers under times")
            key, source = str(entry["key"]), str(entry["source"])
            for choice in choices:
                value, times = (None, float(choice)) if "times" in entry else (choice, None)
                found.append(Alternative(part, key, value, times, source))
    files = Counter(slug(each.name) for each in found)
    if shared := [each.name for each in found if files[slug(each.name)] > 1]:
        raise SceneError(
            f"{path}: found {' and '.join(shared)}, which share a file name; allowed: names that differ in it"
        )
    return found


def member_scenes(
    config: Document, devices: Mapping[str, Document], alternative: Alternative | None, half_cycle: str
) -> Scenes:
    """Scene files of a member. Without an alternative all devices that have half-cycles, as they are.

    An alternative of the model concerns all of them but those whose files have a value of their own that is no
    assumption; one of devices those that assume the value. Raises SceneError if it is a key that none has, or a factor
    on what is no number, and if no device has half-cycles.
    """
    cycled = {
        name: with_value(document, HALF_CYCLE, half_cycle, "varied: half-cycle")
        for name, document in devices.items()
        if "half_cycle" in document["stimulus"]
    }
    if not cycled:
        raise SceneError(f"ensemble: no device has a value {HALF_CYCLE}")
    if alternative is None:
        return Scenes(config, cycled)
    assumed = {name: _varied(cycled[name], alternative) for name in assuming(cycled, alternative.key)}
    if alternative.part == "model":
        return Scenes(_varied(config, alternative), cycled | assumed)
    if not assumed:
        raise SceneError(f"ensemble: {assumed_by_none(cycled, alternative.key)}")
    return Scenes(config, assumed)


def _varied(document: Document, alternative: Alternative) -> Document:
    """The document with the alternative in place of its own value. Raises SceneError if it has none."""
    known, key = dict(quantities_of(document)), by_number(alternative.key, [document])
    require_written(key, known)
    return with_value(document, key, alternative.instead_of(known[key]["value"]), f"varied: {alternative.source}")


def require_written(key: str, known: Mapping[str, Any]) -> None:
    """Raise SceneError unless an alternative's key is one of those in config.yaml."""
    if key not in known:
        raise SceneError(f"ensemble: {no_such_value(key, 'config.yaml', list(known))}")


def assuming(devices: Mapping[str, Document], key: str) -> list[str]:
    """Names of the devices whose value at a key is an assumption, by their documents."""
    found = {name: dict(quantities_of(document)).get(key, {}) for name, document in devices.items()}
    return [name for name, quantity in found.items() if is_assumed(quantity)]


def assumed_by_none(devices: Mapping[str, Document], key: str) -> str:
    """What is wrong with a key whose value no device assumes, by their documents."""
    known = {known for document in devices.values() for known, _ in quantities_of(document)}
    return f"no device here assumes a value {key}{hint('' if key in known else closest(key, sorted(known)))}"


def is_assumed(quantity: Mapping[str, Any]) -> bool:
    """Whether a quantity of a scene file is an assumption, by its source."""
    return str(quantity.get("source")).startswith(Origin.ASSUMPTION)


def named_alternative(alternatives: Sequence[Alternative], member: str) -> Alternative | None:
    """The alternative whose name makes a slug, or None for the scenes as configured. Raises SceneError."""
    by_slug = {slug(AS_CONFIGURED): None, **{slug(each.name): each for each in alternatives}}
    if member not in by_slug:
        raise SceneError(f"ensemble: found the member {member}; allowed: {', '.join(by_slug)}")
    return by_slug[member]


def write_scenes(
    folder: Path,
    config: Document,
    devices: Mapping[str, Document],
    alternative: Alternative | None,
    half_cycle: str,
) -> tuple[Path, list[Path]]:
    """Write the scene files of a member: a folder for `--config scenes=FOLDER`. Returns those of config and devices.
    Raises SceneError as `member_scenes`.
    """
    scenes = member_scenes(config, devices, alternative, half_cycle)
    (folder / "devices").mkdir(parents=True, exist_ok=True)
    files = {folder / "config.yaml": scenes.config}
    files |= {folder / "devices" / f"{name}.yaml": document for name, document in scenes.devices.items()}
    for path, document in files.items():
        write_text(path, yaml.safe_dump(document, sort_keys=False))
    first, *rest = files
    return first, rest
