"""Scene files: YAML to a frozen Scene.

Every leaf of a scene file is a quantity: a mapping with `value`, `unit` and `source`. The schemas in
`workflow/schemas` fix keys, units and ranges (see `validation`); this module only builds.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from .errors import SceneError
from .scene import (
    ActuatorRow,
    Body,
    ContactLaw,
    Control,
    Criterion,
    Device,
    Finger,
    GaborFilter,
    Layer,
    Material,
    Model,
    Numerics,
    ReadoutRule,
    Scene,
    Side,
    Skips,
)
from .stimuli import KINDS


def read_yaml(path: Path) -> dict[str, Any]:
    """The mapping in a YAML file. Raises SceneError if the file is missing, empty, not YAML, or has a key twice."""

    class Loader(yaml.SafeLoader):
        """Refuses a mapping that has a key twice; PyYAML alone would take the last."""

        def compose_mapping_node(self, anchor: Any) -> yaml.MappingNode:
            node = super().compose_mapping_node(anchor)
            seen: dict[str, int] = {}
            for key, _ in node.value:
                if not isinstance(key, yaml.ScalarNode):
                    continue
                if key.value in seen:
                    problem = f"found the key {key.value!r} twice (first in line {seen[key.value]}), allowed once"
                    raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
                seen[key.value] = key.start_mark.line + 1
            return node

    try:
        document = yaml.load(path.read_text(encoding="utf-8"), Loader)  # Loader is a SafeLoader
    except OSError as error:
        raise SceneError(f"{path}: cannot be read as a YAML file: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise SceneError(f"{path}: must be UTF-8 text, found byte 0x{error.object[error.start]:02x}") from error
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        raise SceneError(f"{path}: is not valid YAML: {where}{error.problem}") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise SceneError(f"{path}: is not valid YAML: {' '.join(str(error).split())}") from error
    if not isinstance(document, dict):
        found = "an empty file" if document is None else f"the {type(document).__name__} {document!r:.40}"
        raise SceneError(f"{path}: must hold a mapping of keys to values, found {found}")
    return document


def load_scene(config: Path, device: Path) -> Scene:
    """The scene of a config file and a device file (both already validated). Raises SceneError.

    >>> scene = load_scene(Path("config/config.yaml"), Path("config/devices/device2.yaml"))
    >>> [condition.name for condition in scene.device.conditions]
    ['alternate_000', 'alternate_090', 'alternate_180']
    """
    model = build_model(read_yaml(config))
    try:
        return Scene(model, build_device(device, read_yaml(device)))
    except SceneError as error:
        raise SceneError(f"{device}: {error}") from error


def build_model(config: dict[str, Any]) -> Model:
    """The model of a validated config mapping. Raises SceneError."""
    finger, contact, readout = (_values(config[key]) for key in ("finger", "contact", "readout"))
    return Model(
        Finger(
            finger["width"],
            finger["height"],
            finger["bone_width"],
            finger["nail_width"],
            tuple(_layer(entry) for entry in finger["pad"]),
            tuple(_layer(entry) for entry in finger["dorsal"]),
        ),
        ContactLaw(contact["friction"], Criterion(contact["criterion"])),
        GaborFilter(**_values(config["filter"])),
        ReadoutRule(readout["layer_above"], Side(readout["side"]), readout["span_margin"]),
        Numerics(**_values(config["numerics"])),
        Skips(**_values(config["skips"])),
    )


def build_device(path: Path, document: dict[str, Any]) -> Device:
    """The device of the validated mapping in a device file; its name is the file's, and recordings lie in its folder.

    Raises SceneError.
    """
    plain = _values(document)
    row, stimulus = plain["actuators"], plain["stimulus"]
    body = None
    if row["body"]["kind"] == "deformable":
        body = Body(Material(row["body"]["modulus"], row["body"]["poisson"]), row["body"]["thickness"])
    count = row["count"]
    positions = tuple((i - (count - 1) / 2.0) * row["pitch"] for i in range(count))
    actuators = ActuatorRow(positions, row["width"], row["edge_radius"], body)
    conditions = KINDS[stimulus["kind"]](stimulus, count, path.parent)
    return Device(path.stem, plain["title"], Control(plain["control"]), actuators, tuple(conditions))


def recordings(device: Path) -> list[Path]:
    """The files that a device file (already validated) names, in its order. Raises SceneError.

    >>> recordings(Path("config/devices/device2.yaml"))
    []
    """
    return [device.parent / name for name in _named_files(_values(read_yaml(device)["stimulus"]))]


def _named_files(node: Any) -> Iterator[str]:
    """Texts at the keys `file` of a plain document."""
    for key, child in node.items() if isinstance(node, dict) else ():
        if key == "file" and isinstance(child, str):
            yield child
        yield from _named_files(child)


def _values(node: Any) -> Any:
    """The document with every quantity replaced by its value."""
    if isinstance(node, dict):
        return node["value"] if "value" in node else {key: _values(child) for key, child in node.items()}
    if isinstance(node, list):
        return [_values(child) for child in node]
    return node


def _layer(entry: dict[str, Any]) -> Layer:
    return Layer(entry["name"], entry["thickness"], Material(entry["modulus"], entry["poisson"]))
