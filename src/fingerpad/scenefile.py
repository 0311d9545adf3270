"""Scene files: YAML to a frozen Scene.

Every leaf of a scene file is a quantity: a mapping with `value`, `unit` and `source`. The schemas in
`workflow/schemas` fix keys, units and ranges (see `validation`); this module only builds.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from .errors import SceneError
from .scene import (
    ActuatorRow,
    Body,
    Condition,
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

CYCLE_STEPS = 16  # rows with which `playback: cycle` samples one sinusoid [1]; source: 16 per period, linear between


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
        return Scene(model, build_device(device.stem, read_yaml(device)))
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


def build_device(name: str, document: dict[str, Any]) -> Device:
    """The device of a validated device mapping; its name is the file's. Raises SceneError."""
    plain = _values(document)
    row, stimulus = plain["actuators"], plain["stimulus"]
    body = None
    if row["body"]["kind"] == "deformable":
        body = Body(Material(row["body"]["modulus"], row["body"]["poisson"]), row["body"]["thickness"])
    count = row["count"]
    positions = tuple((i - (count - 1) / 2.0) * row["pitch"] for i in range(count))
    actuators = ActuatorRow(positions, row["width"], row["edge_radius"], body)
    conditions = {"phased": _phased, "alternating": _alternating, "history": _history}[stimulus["kind"]]
    return Device(name, plain["title"], Control(plain["control"]), actuators, tuple(conditions(stimulus, count)))


def _values(node: Any) -> Any:
    """The document with every quantity replaced by its value."""
    if isinstance(node, dict):
        return node["value"] if "value" in node else {key: _values(child) for key, child in node.items()}
    if isinstance(node, list):
        return [_values(child) for child in node]
    return node


def _layer(entry: dict[str, Any]) -> Layer:
    return Layer(entry["name"], entry["thickness"], Material(entry["modulus"], entry["poisson"]))


def _directed(direction: str, displacement: np.ndarray) -> dict[str, np.ndarray]:
    """Displacements (n_times, n_actuators) [mm] as normal and tangential histories."""
    still = np.zeros_like(displacement)
    normal = direction == "normal"
    return {"normal": displacement if normal else still, "tangential": still if normal else displacement}


def _phased(stimulus: dict[str, Any], count: int) -> list[Condition]:
    """Actuator i at A cos(k_i p) (snapshot), or A sin(w t + k_i p) over one period (cycle)."""
    conditions = []
    for dispersion, groups in stimulus["dispersions"].items():
        if len(groups) != count:
            raise SceneError(f"stimulus.dispersions.{dispersion}: needs {count} group indices, found {len(groups)}")
        for phase in stimulus["phases"]:
            lag = np.asarray(groups, dtype=float) * math.radians(phase)
            if stimulus["playback"] == "snapshot":
                # cos(pi/2) is 6e-17 in floating point; a pin at its zero crossing rests
                displacement = stimulus["amplitude"] * np.round(np.cos(lag), 15)[None, :]
                time = np.array([1.0])
            else:
                time = np.arange(1, CYCLE_STEPS + 1) / CYCLE_STEPS
                displacement = stimulus["amplitude"] * np.sin(2.0 * math.pi * time[:, None] + lag)
            conditions.append(
                Condition(
                    f"{dispersion}_{phase:03g}",
                    dispersion,
                    float(phase),
                    time,
                    **_directed(stimulus["direction"], displacement),
                )
            )
    return conditions


def _alternating(stimulus: dict[str, Any], count: int) -> list[Condition]:
    """Actuator i at absolute + (-1)^i relative / 2 (paper, Table 1)."""
    sign = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    return [
        Condition(
            f"alternate_{row['phase']:03g}",
            "alternate",
            float(row["phase"]),
            np.array([1.0]),
            **_directed(stimulus["direction"], row["absolute"] + sign[None, :] * row["relative"] / 2.0),
        )
        for row in stimulus["rows"]
    ]


def _history(stimulus: dict[str, Any], count: int) -> list[Condition]:
    """Any path: per-actuator normal and tangential displacements at given times."""
    conditions = []
    for name, history in stimulus["histories"].items():
        arrays = {}
        for key in ("normal", "tangential"):
            rows = history[key]
            if any(len(row) != count for row in rows):
                raise SceneError(f"stimulus.histories.{name}.{key}: every row needs {count} numbers (one an actuator)")
            arrays[key] = np.asarray(rows, dtype=float)
        time = np.asarray(history["time"], dtype=float)
        conditions.append(Condition(name, history["dispersion"], float(history["phase"]), time, **arrays))
    return conditions
