"""Scene files: YAML to a frozen Scene.

Every leaf of a scene file is a quantity: a mapping with `value`, `unit` and `source`. The schemas in
`workflow/schemas` fix keys, units and ranges (see `validation`); this module only builds.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import yaml

from ..errors import SceneError
from ..files import require_readable
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

MERGE, TEXT, BOOLEAN, INTEGER, FLOAT = (f"tag:yaml.org,2002:{end}" for end in ("merge", "str", "bool", "int", "float"))
# as YAML 1.2 has them; PyYAML reads YAML 1.1, in which 045 is 37, 1:30 is 90, 1e-3 a text, and a condition `off` false
PLAIN = {
    BOOLEAN: r"(true|True|TRUE|false|False|FALSE)$",
    INTEGER: r"[-+]?[0-9]+$",
    FLOAT: r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$|[-+]?\.(inf|Inf|INF)$|\.(nan|NaN|NAN)$",
}
MOST_REPEATED = 100_000  # values [1] that aliases may repeat; source: assumption: rows of a history that are alike
KINEMATICS = {"both": tuple(Kinematics), "small": (Kinematics.SMALL,)}  # what files call them
TABS = "; indent with spaces"
QUOTES = "; text with a colon or a comma needs quotes"  # what is wrong most often where a flow mapping is not one
DECIMALS = 12  # of a place [mm]; keeps rounding from telling a row that mirrors from one that does not
REMEMBERED = 16  # texts of files [1]; source: config, two schemas and some devices
LARGEST_FILE = 10_000_000  # bytes; source: the longest history that the schema allows takes as much


class _Loader(yaml.SafeLoader):
    """Refuses what PyYAML would take: a key twice (it takes the last), merges, tags, and aliases of aliases, which make
    lists beyond any memory from a few lines. Its numbers and truths are PLAIN.
    """

    yaml_implicit_resolvers = {  # noqa: RUF012 - PyYAML's own name, which it copies before it adds to it
        first: [each for each in known if each[0] not in PLAIN]
        for first, known in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }

    def get_single_node(self) -> yaml.Node | None:
        node = super().get_single_node()
        known: dict[int, int] = {}
        if node is not None and _written_out(node, known) - len(known) > MOST_REPEATED:
            problem = f"found aliases that repeat more than {MOST_REPEATED} values, allowed: values written out"
            raise yaml.MarkedYAMLError(problem=problem)
        return node

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        event = self.peek_event()  # type: ignore[no-untyped-call]  # so are the stubs
        if (tag := getattr(event, "tag", None)) is not None:
            tag = tag.replace("tag:yaml.org,2002:", "!!")
            raise yaml.MarkedYAMLError(problem=f"found the tag {tag}, allowed: none", problem_mark=event.start_mark)
        return super().compose_node(parent, index)

    def compose_mapping_node(self, anchor: Any) -> yaml.MappingNode:
        node = super().compose_mapping_node(anchor)
        seen: dict[str, int] = {}
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode) or key.tag == MERGE:
                found = f"{key.id} as a key" if key.tag != MERGE else "merge key <<"
                problem = f"found a {found}, allowed: texts as keys, each with its value written out"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            if key.value in seen:
                problem = f"found the key {key.value!r} twice (first in line {seen[key.value]}), allowed once"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            seen[key.value] = key.start_mark.line + 1
            if key.value.startswith("0") and key.value.isdecimal():
                key.tag = TEXT  # {value: 0,025} has the key 025, which is 25 to YAML
        return node

    def construct_integer(self, node: yaml.ScalarNode) -> int:
        return int(node.value)


for _tag, _pattern in PLAIN.items():
    _Loader.add_implicit_resolver(_tag, re.compile(_pattern), list("-+.0123456789tTfF"))
_Loader.add_constructor(INTEGER, _Loader.construct_integer)


def read_yaml(path: Path) -> dict[str, Any]:
    """The mapping in a YAML file.

    Raises SceneError if the file is missing, empty, too large, not YAML, or has a key twice, a tag or many aliases.
    """
    try:
        require_readable(path, LARGEST_FILE, "YAML", SceneError)
        node = _composed(path.read_text(encoding="utf-8"))
        document = None if node is None else _Loader("").construct_document(node)
    except OSError as error:
        raise SceneError(f"{path}: cannot be read as a YAML file: {error.strerror}") from error
    except UnicodeDecodeError as error:
        line = 1 + error.object.count(b"\n", 0, error.start)
        found = f"found byte 0x{error.object[error.start]:02x}"
        raise SceneError(f"{path}: line {line}: must be UTF-8 text, {found}; save it as UTF-8") from error
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        begun = error.context_mark
        context = f" ({error.context} that began in line {begun.line + 1})" if begun else ""
        hint = QUOTES if "flow mapping" in str(error.context) else TABS if r"\t" in str(error.problem) else ""
        raise SceneError(f"{path}: is not valid YAML: {where}{error.problem}{context}{hint}") from error
    except RecursionError as error:
        raise SceneError(f"{path}: is nested too deeply; allowed: the few levels of the shipped files") from error
    except (yaml.YAMLError, ValueError) as error:
        raise SceneError(f"{path}: is not valid YAML: {' '.join(str(error).split())}") from error
    if not isinstance(document, dict):
        found = "an empty file" if document is None else f"the {type(document).__name__} {document!r:.40}"
        raise SceneError(f"{path}: must hold a mapping of keys to values, found {found}")
    return document


def read_values(text: str) -> list[Any]:
    """The values that a text lists as a scene file would, between commas; none if it is no such text.

    >>> read_values("0.3, 0.6"), read_values("[0, 1], [1, 0]"), read_values("0.3]")
    ([0.3, 0.6], [[0, 1], [1, 0]], [])
    """
    try:
        node = _composed(f"[{text}]")
        values = [] if node is None else _Loader("").construct_document(node)
    except (yaml.YAMLError, ValueError, RecursionError):
        return []
    return values if isinstance(values, list) else []


@functools.lru_cache(maxsize=REMEMBERED)  # a workflow reads each of its few files many times, and this takes longest
def _composed(text: str) -> yaml.Node | None:
    """The nodes of a YAML text."""
    return yaml.compose(text, _Loader)


def _written_out(node: yaml.Node, known: dict[int, int]) -> int:
    """Number of nodes below and with a node if aliases were written out. known: of each node, 0 while it is counted."""
    if id(node) not in known:
        known[id(node)] = 0
        pairs = node.value if isinstance(node, yaml.MappingNode) else []
        children = node.value if isinstance(node, yaml.SequenceNode) else [child for pair in pairs for child in pair]
        known[id(node)] = 1 + sum(_written_out(child, known) for child in children)
    elif known[id(node)] == 0:
        problem = "found an alias of what it is a part of, allowed: aliases of other values"
        raise yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)
    return known[id(node)]


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
