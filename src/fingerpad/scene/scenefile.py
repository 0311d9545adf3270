"""Scene files: YAML to a frozen Scene.

Every leaf of a scene file is a quantity: a mapping with `value`, `unit` and `source`. The schemas in
`workflow/schemas` fix keys, units and ranges (see `validation`), `yamlfile` reads; this module only builds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from ..errors import SceneError
from ..requirements import require
from .bodies import BODIES
from .contact_law import ContactLaw, Criterion, FrictionFrom, TurningNormal
from .device import ActuatorRow, Body, Control, Device, evenly
from .finger import Finger, Layer, Material
from .numerics import Numerics, Skips
from .readout import GaborFilter, ReadoutRule, Side
from .scene import Model, Scene
from .stimuli import CYCLES, KINDS
from .tissue_law import Kinematics, Law, TissueLaw
from .vibration_rule import Relaxation, VibrationRule
from .yamlfile import read_yaml

KINEMATICS = {"both": tuple(Kinematics), "small": (Kinematics.SMALL,)}  # what files call them
DECIMALS = 12  # of a place [mm]; keeps rounding from telling a row that mirrors from one that does not


def load_scene(config: Path, device: Path, kinematics: Kinematics = Kinematics.SMALL) -> Scene:
    """The scene of a config file and a device file (both already validated), with those kinematics. Raises SceneError.

    >>> scene = load_scene(Path("config/config.yaml"), Path("config/devices/device2.yaml"))
    >>> [condition.name for condition in scene.device.conditions]
    ['alternate_000', 'alternate_090', 'alternate_180']
    """
    model, document = build_model(read_yaml(config)), read_yaml(device)
    try:
        return Scene(with_contact(model, document), build_device(device, document)).with_kinematics(kinematics)
    except SceneError as error:
        raise SceneError(f"{device}: {error}") from error


def build_model(config: dict[str, Any]) -> Model:
    """The model of a validated config mapping. Raises SceneError."""
    finger, tissue, contact, readout, vibration = (
        plain_values(config[key]) for key in ("finger", "tissue", "contact", "readout", "vibration")
    )
    return Model(
        finger=Finger(
            width=finger["width"],
            height=finger["height"],
            bone_width=finger["bone_width"],
            nail_width=finger["nail_width"],
            pad=tuple(_layer(entry) for entry in finger["pad"]),
            dorsal=tuple(_layer(entry) for entry in finger["dorsal"]),
        ),
        tissue=TissueLaw(
            kinematics=Kinematics.SMALL,
            computed=KINEMATICS[tissue["kinematics"]],
            law=Law(tissue["law"]),
            ogden_exponent=tissue["ogden_exponent"],
        ),
        contact=_contact_law(contact),
        gabor=GaborFilter(**plain_values(config["filter"])),
        readout=ReadoutRule(readout["layer_above"], Side(readout["side"]), readout["span_margin"]),
        vibration=VibrationRule(
            relaxation=Relaxation(*(tuple(vibration[key]) for key in ("shares", "times", "layers"))),
            density=vibration["density"],
            inertia_limit=vibration["inertia_limit"],
            steps=vibration["steps"],
        ),
        numerics=Numerics(**plain_values(config["numerics"])),
        skips=Skips(**plain_values(config["skips"])),
    )


def with_contact(model: Model, device: dict[str, Any]) -> Model:
    """The model with what a device's validated mapping says of contact in place of its own. Raises SceneError."""
    own = plain_values(device.get("contact", {}))
    return replace(model, contact=_contact_law(asdict(model.contact) | own))


def build_device(path: Path, document: dict[str, Any]) -> Device:
    """The device of the validated mapping in a device file; its name is the file's, and recordings lie in its folder.

    Raises SceneError.
    """
    plain = plain_values(document)
    row, stimulus, control = plain["actuators"], plain["stimulus"], Control(plain["control"])
    require(
        not (control is Control.FORCE and plain.get("interfaces") == "both"),
        f"{path.stem}: found interfaces: both with control: force; allowed: shear, or leave it out: displacements of"
        " controlled forces are unknown without friction",
    )
    actuators = ActuatorRow(_positions(row), row["width"], row["edge_radius"], _body(row["body"]))
    count = len(actuators.positions)
    conditions = KINDS[stimulus["kind"]](stimulus, count, path.parent)
    frequencies = tuple(stimulus.get("frequency_hz", ()))
    cycles = tuple(CYCLES[stimulus["kind"]](stimulus, count)) if stimulus["kind"] in CYCLES else ()
    return Device(
        name=path.stem,
        title=plain["title"],
        control=control,
        actuators=actuators,
        conditions=tuple(conditions),
        cycles=cycles,
        frequencies=frequencies,
        kinematics=KINEMATICS[plain.get("kinematics", "both")],
        frictionless=plain.get("interfaces", "both") == "both",
    )


def recordings(device: Path) -> list[Path]:
    """The files that a device file (already validated) names, in its order. Raises SceneError.

    >>> recordings(Path("config/devices/device2.yaml"))
    []
    """
    return [device.parent / name for name in _named_files(plain_values(read_yaml(device)["stimulus"]))]


def _named_files(node: Any) -> Iterator[str]:
    """Texts at the keys `file` of a plain document."""
    for key, child in node.items() if isinstance(node, dict) else ():
        if key == "file" and isinstance(child, str):
            yield child
        yield from _named_files(child)


def plain_values(node: Any) -> Any:
    """A document, or a part of one, with every quantity replaced by its value, and without the source of a kind."""
    if isinstance(node, dict) and "value" in node:
        return node["value"]
    if isinstance(node, dict):
        return {key: plain_values(child) for key, child in node.items() if key != "source" or isinstance(child, dict)}
    if isinstance(node, list):
        return [plain_values(child) for child in node]
    return node


def _contact_law(given: dict[str, Any]) -> ContactLaw:
    """The law of the plain values under `contact`. Raises SceneError."""
    return ContactLaw(
        friction=given["friction"],
        friction_from=FrictionFrom(given["friction_from"]),
        turning_normal=TurningNormal(given["turning_normal"]),
        criterion=Criterion(given["criterion"]),
        depth=given["depth"],
        force=given["force"],
    )


def _positions(row: dict[str, Any]) -> tuple[float, ...]:
    """Centres [mm] of the actuators of the plain values under `actuators`. Raises SceneError if they are given twice.

    >>> _positions({"count": 2, "pitch": 2.0, "offset": 0.5})
    (-0.5, 1.5)
    >>> _positions({"positions": [0.0, 2.1, 4.2], "offset": -2.1})
    (-2.1, 0.0, 2.1)
    """
    twice = [key for key in ("count", "pitch") if "positions" in row and key in row]
    require(not twice, f"actuators: found positions and {' and '.join(twice)}; allowed: positions, or count and pitch")
    places = row["positions"] if "positions" in row else evenly(row["count"], row["pitch"])
    # ASSUME: actuators.offset: where a file says nothing, the finger lies over the middle of the row
    return tuple(round(x + row.get("offset", 0.0), DECIMALS) for x in places)


def _body(given: dict[str, Any]) -> Body | None:
    """The body of the plain values under `actuators.body`; None if it is rigid. Raises SceneError."""
    rest = {key: value for key, value in given.items() if key not in ("kind", "modulus", "poisson")}
    body = BODIES[given["kind"]]
    return body(Material(given["modulus"], given["poisson"]), **rest) if body else None


def _layer(entry: dict[str, Any]) -> Layer:
    return Layer(entry["name"], entry["thickness"], Material(entry["modulus"], entry["poisson"]))
