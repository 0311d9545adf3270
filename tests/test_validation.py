"""Mistakes in scene files: each gets one message that names file, key, found, allowed and what was meant."""

from __future__ import annotations

import copy
import functools
import io
import operator
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
import yaml
from jsonschema import Draft202012Validator

from fingerpad.errors import SceneError
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.device_names import LONGEST_NAME, known_devices, require_device, require_new_name
from fingerpad.scene.meant import RESERVED, _meant_unit
from fingerpad.scene.problems import MOST_REPORTED
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.validation import check_config, check_device
from fingerpad.scene.yamlfile import read_values
from fingerpad.vibration.forecast import HIGHEST, LOWEST
from scenes import scene

ROOT = Path(__file__).parents[1]
SCHEMAS = ROOT / "workflow" / "schemas"
CONFIG = ROOT / "config" / "config.yaml"
DEVICES = ROOT / "config" / "devices"
NAN, INF = float("nan"), float("inf")
DELETED = object()


def quantity(value: Any, unit: str) -> dict[str, Any]:
    return {"value": value, "unit": unit, "source": "assumption: test"}


STILL = [[0.0, 0.0, 0.0, 0.0]] * 2
TAP = {
    "dispersion": quantity("one", "1"),
    "phase": quantity(0, "deg"),
    "time": quantity([0.5, 1.0], "s"),
    "normal": quantity([[0.01, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.02]], "mm"),
    "tangential": quantity(STILL, "mm"),
}
HISTORY = {"kind": "history", "histories": {"tap": TAP}}

Edits = dict[str, Any]


def edited(document: dict[str, Any], edits: Edits) -> dict[str, Any]:
    """A copy with the values at dotted keys replaced, added or deleted."""
    document = copy.deepcopy(document)
    for key, value in edits.items():
        *way, last = (int(step) if step.isdigit() else step for step in re.split(r"[.\[\]]+", key.rstrip("]")))
        node: Any = document
        for step in way:
            node = node[step]
        if value is DELETED:
            del node[last]
        else:
            node[last] = copy.deepcopy(value)
    return document


def write(folder: Path, name: str, document: Any) -> Path:
    path = folder / name
    path.write_text(yaml.safe_dump(document, sort_keys=False, allow_unicode=True), encoding="utf-8")
    return path


def message_of(path: Path, device: bool = True) -> str:
    with pytest.raises(SceneError) as caught:
        check_device(path, SCHEMAS, CONFIG) if device else check_config(path, SCHEMAS)
    return str(caught.value)


def leaves(node: Any, key: str = "") -> Iterator[str]:
    """Dotted keys of all values that are no mappings, and of all entries of lists."""
    if isinstance(node, dict | list) and node:
        children = node.items() if isinstance(node, dict) else enumerate(node)
        for step, child in children:
            inner = f"{key}[{step}]" if isinstance(node, list) else f"{key}.{step}".removeprefix(".")
            yield from leaves(child, inner)
    else:
        yield key


# what is edited, the key that the message must name, and what else it must say
CONFIG_MISTAKES: dict[str, tuple[Edits, str, list[str]]] = {
    "misspelled section": (
        {"finger": DELETED, "fingr": {}},
        "fingr",
        [
            "an unknown key",
            "finger, tissue, contact, readout, filter, vibration, numerics",
            "did you mean finger?",
            "(transverse section",
        ],
    ),
    "too few increments to tell an error from halves of them": (
        {"numerics.indentation_increments.value": 5},
        "numerics.indentation_increments.value",
        ["found 5", ">= 6, <= 10000", "(load increments"],
    ),
    "missing section": (
        {"filter": DELETED},
        "filter",
        ["found nothing", "a mapping with the keys wavelength_strain", "(Gabor"],
    ),
    "misspelled key": (
        {"finger.width": DELETED, "finger.widht": quantity(16.0, "mm")},
        "finger.widht",
        ["an unknown key", "width, height, bone_width", "did you mean width?", "(width of the elliptical outline)"],
    ),
    "unknown key": (
        {"contact.colour": quantity(1.0, "1")},
        "contact.colour",
        ["an unknown key", "the keys friction, friction_from, turning_normal, criterion, depth, force ("],
    ),
    "key that is a number": (
        {"readout": {1: 2}},
        "readout.1",
        ["an unknown key", "the keys layer_above, side, span_margin"],
    ),
    "missing key": (
        {"numerics.growth": DELETED},
        "numerics.growth",
        ["found nothing", "a mapping with the keys value, unit, source", "(growth of the element size"],
    ),
    "bare number": (
        {"finger.width": 16.0},
        "finger.width",
        ["found 16.0", "keys value, unit, source", "did you mean {value: 16.0, unit: mm, source: ...}?"],
    ),
    "empty value": ({"finger.width": None}, "finger.width", ["found null", "a mapping with the keys"]),
    "missing value": ({"finger.width.value": DELETED}, "finger.width.value", ["found nothing", ">= 1, <= 100"]),
    "missing unit": ({"finger.width.unit": DELETED}, "finger.width.unit", ["found nothing", "allowed: mm ("]),
    "missing source": ({"finger.width.source": DELETED}, "finger.width.source", ["found nothing", '"paper: ..."']),
    "short source": ({"finger.width.source": "me"}, "finger.width.source", ["found me", "5 characters or more"]),
    "source without a reason": (
        {"finger.width.source": "assumption: "},
        "finger.width.source",
        ["found 'assumption: '", '"assumption: why"'],
    ),
    "source of no form": (
        {"finger.width.source": "Paper, Table 2"},
        "finger.width.source",
        ["found Paper, Table 2", "(where the value comes from)"],
    ),
    "text for a number": ({"finger.width.value": "wide"}, "finger.width.value", ["found wide", "a finite number"]),
    "number as text": (
        {"numerics.growth.value": "0,2"},
        "numerics.growth.value",
        ["found 0,2", "a finite number", "did you mean 0.2?"],
    ),
    "boolean for a number": (
        {"contact.friction.value": True},
        "contact.friction.value",
        ["found true", "finite number"],
    ),
    "not a number": (
        {"contact.friction.value": NAN},
        "contact.friction.value",
        ["found .nan", "0, or a finite number"],
    ),
    "infinity": ({"contact.friction.value": INF}, "contact.friction.value", ["found .inf", "0, or a finite number"]),
    "minus infinity": (
        {"contact.friction.value": -INF},
        "contact.friction.value",
        ["found -.inf", "0, or a finite number"],
    ),
    "number beyond floating point": ({"contact.friction.value": 10**400}, "contact.friction.value", ["found 1000"]),
    "too little friction": ({"contact.friction.value": 1e-4}, "contact.friction.value", ["0, or a finite number"]),
    "negative number": (
        {"contact.friction.value": -0.1},
        "contact.friction.value",
        ["found -0.1", "finite number from 0.001 to 5", "(Coulomb friction coefficient"],
    ),
    "negative thickness": ({"finger.pad[2].thickness.value": -1.4}, "finger.pad[2].thickness.value", ["found -1.4"]),
    "incompressible": ({"finger.pad[0].poisson.value": 0.5}, "finger.pad[0].poisson.value", ["found 0.5", "< 0.5"]),
    "fraction for a whole number": (
        {"numerics.max_cuts.value": 2.5},
        "numerics.max_cuts.value",
        ["found 2.5", "a whole number, >= 0, <= 50"],
    ),
    "whole number with a point": (
        {"numerics.max_cuts.value": 3.0},
        "numerics.max_cuts.value",
        ["found 3.0", "a whole number", "did you mean 3?"],
    ),
    "unit 1 without quotes": ({"contact.friction.unit": 1}, "contact.friction.unit", ["found 1;", "allowed: '1'"]),
    "misspelled choice": (
        {"contact.criterion.value": "Ful"},
        "contact.criterion.value",
        ["found Ful", "one of full, touch", "did you mean full?", "(when pre-indentation ends"],
    ),
    "one layer on the pad": (
        {"finger.pad": []},
        "finger.pad",
        ["found 0 entries", "a list, at least 2 long", "(layers between pad and bone"],
    ),
    "layers as a mapping": ({"finger.dorsal": {"nail": 1}}, "finger.dorsal", ["found {nail: 1}", "a list"]),
    "layer name with a space": (
        {"finger.pad[0].name": "Stratum corneum"},
        "finger.pad[0].name",
        ["found Stratum corneum", "small letters, digits and underscores", "did you mean stratum_corneum?"],
    ),
    "layer name with a final newline": ({"finger.pad[0].name": "horn\n"}, "finger.pad[0].name", ["small letters"]),
    "two layers of one name": (
        {"finger.dorsal[1].name": "dermis"},
        "finger.dorsal[1].name",
        ["found dermis 2 times", "each name once"],
    ),
    "unknown layer": (
        {"readout.layer_above.value": "epidermis"},
        "readout.layer_above.value",
        ["found epidermis", "one of stratum_corneum, viable_epidermis, dermis", "did you mean viable_epidermis?"],
    ),
    "unknown layer that relaxes": (
        {"vibration.layers.value": ["dermis", "dermiss"]},
        "vibration.layers.value[1]",
        ["found dermiss", "one of stratum_corneum, viable_epidermis", "did you mean dermis?", "(a layer that relaxes)"],
    ),
    "layer that reaches the bone": (
        {"readout.layer_above.value": "subcutaneous_tissue"},
        "readout.layer_above.value",
        ["found subcutaneous_tissue", "one of stratum_corneum", "not the last one"],
    ),
    "no bone left": (
        {"finger.pad[3].thickness.value": 9.0},
        "finger",
        ["leave no bone", "pad 11 mm", "height 13 mm", "(transverse section of the fingertip)"],
    ),
    "bone wider than the finger": ({"finger.bone_width.value": 15.9}, "finger", ["bone_width 15.9 mm", "width 16 mm"]),
}

SOFT = {"thickness": quantity(1, "mm"), "poisson": quantity(0.4, "1")}
DEVICE_MISTAKES: dict[str, tuple[Edits, str, list[str]]] = {
    "misspelled section": (
        {"stimulus": DELETED, "stimuli": {}},
        "stimuli",
        [
            "an unknown key",
            "title, control, interfaces, kinematics, actuators, contact, stimulus",
            "did you mean stimulus?",
        ],
    ),
    "empty title": ({"title.value": ""}, "title.value", ["found ''", "a line of 1 to 60 characters", "(what figures"]),
    "title of two lines": ({"title.value": "a\nb"}, "title.value", ["a line of 1 to 60 characters"]),
    "misspelled control": ({"control.value": "froce"}, "control.value", ["one of displacement, force", "mean force?"]),
    "no actuator": ({"actuators.count.value": 0}, "actuators.count.value", ["found 0", "a whole number, >= 1, <= 64"]),
    "half an actuator": ({"actuators.count.value": 4.0}, "actuators.count.value", ["found 4.0", "did you mean 4?"]),
    "overlapping actuators": (
        {"actuators.pitch.value": 0.5},
        "actuators",
        ["overlap", "width 1 mm", "distance 0.5 mm", "(a row of equal actuators"],
    ),
    "actuator beyond the finger": (
        {"actuators.pitch.value": 6.0},
        "actuators",
        ["reaches x = 9.5 mm", "less than half the finger's width, 8 mm"],
    ),
    "edges rounder than the actuator": (
        {"actuators.edge_radius.value": 0.6},
        "actuators",
        ["edge_radius must lie between 0 and width/2 = 0.5 mm", "found 0.6"],
    ),
    "unknown body": ({"actuators.body.kind": "soft"}, "actuators.body.kind", ["one of rigid, deformable"]),
    "body without its kind": ({"actuators.body": {}}, "actuators.body.kind", ["nothing", "rigid, deformable"]),
    "rigid body with a modulus": (
        {"actuators.body.modulus": quantity(1.0, "MPa")},
        "actuators.body.modulus",
        ["an unknown key", "the keys kind, source ("],
    ),
    "deformable body without a source": (
        {"actuators.body": {"kind": "deformable", "modulus": quantity(1, "MPa"), **SOFT}},
        "actuators.body.source",
        ["found nothing"],
    ),
    "deformable body without a modulus": (
        {"actuators.body": {"kind": "deformable", "source": "our data sheet", **SOFT}},
        "actuators.body.modulus",
        ["found nothing", "(Young's modulus)"],
    ),
    "stimulus is a number": ({"stimulus": 3}, "stimulus", ["found 3", "a mapping with the keys kind ("]),
    "misspelled kind": (
        {"stimulus.kind": "phasd"},
        "stimulus.kind",
        ["found phasd", "one of phased, alternating, history", "did you mean phased?", "(how the stimulus is given)"],
    ),
    "misspelled key of the kind": (
        {"stimulus.kind": DELETED, "stimulus.knd": "phased"},
        "stimulus.knd",
        ["an unknown key", "did you mean kind?"],
    ),
    "key of another kind": (
        {"stimulus.rows": []},
        "stimulus.rows",
        ["an unknown key", "direction, half_cycle, frequency_hz, amplitude, playback, phases, dispersions"],
    ),
    "unknown direction": (
        {"stimulus.direction.value": "latral"},
        "stimulus.direction.value",
        ["one of normal, lateral", "did you mean lateral?"],
    ),
    "no amplitude": ({"stimulus.amplitude.value": 0}, "stimulus.amplitude.value", ["found 0", "> 0, <= 10"]),
    "negative phase": ({"stimulus.phases.value": [0, -90]}, "stimulus.phases.value[1]", ["found -90", ">= 0, <= 360"]),
    "hidden not-a-number": (
        {"stimulus.phases.value": [0, 90, NAN]},
        "stimulus.phases.value[2]",
        ["found .nan", "a finite number", "(phase differences"],
    ),
    "hidden boolean": ({"stimulus.phases.value": [0, True]}, "stimulus.phases.value[1]", ["found true"]),
    "repeated phase": ({"stimulus.phases.value": [0, 90, 90.0]}, "stimulus.phases.value", ["without repeats"]),
    "conditions that are named alike": (
        {
            "stimulus.phases.value": [5, 22.005],
            "stimulus.dispersions.low_022": {"value": [0, 0, 1, 1], "unit": "1", "source": "paper: Table 1"},
        },
        "stimulus",
        ["condition names must differ", "low_022_005"],
    ),
    "no phase": ({"stimulus.phases.value": []}, "stimulus.phases.value", ["found 0 entries", "at least 1 long"]),
    "no dispersion": ({"stimulus.dispersions": {}}, "stimulus.dispersions", ["found {}", "at least 1 long"]),
    "dispersion that is no name": (
        {"stimulus.dispersions": {"Very High": quantity([0, 1, 0, 1], "1")}},
        "stimulus.dispersions",
        ["the name Very High", "small letters", "did you mean very_high?"],
    ),
    "dispersion that is a number": (
        {"stimulus.dispersions": {1: quantity([0, 1, 0, 1], "1")}},
        "stimulus.dispersions",
        ["the name 1", "begins with a letter"],
    ),
    "dispersion with a reserved name": (
        {"stimulus.dispersions": {"value": quantity([0, 1, 0, 1], "1")}},
        "stimulus.dispersions",
        ["the name value", "none of value, source, false, inf, infinity, nan, null and true"],
    ),
    "dispersion that would be taken for a quantity": (
        {"stimulus.dispersions": {"source": quantity([0, 1, 0, 1], "1")}},
        "stimulus.dispersions",
        ["the name source", "none of value, source, false, inf, infinity, nan, null and true"],
    ),
    "dispersion that tables would take for missing": (
        {"stimulus.dispersions": {"nan": quantity([0, 1, 0, 1], "1")}},
        "stimulus.dispersions",
        ["the name nan", "none of value, source, false, inf, infinity, nan, null and true"],
    ),
    "too few group indices": (
        {"stimulus.dispersions.low.value": [0, 1, 0]},
        "stimulus.dispersions.low",
        ["found 3 group indices; allowed: 4, one for each actuator"],
    ),
    "fractional group index": (
        {"stimulus.dispersions.low.value": [0, 1, 0.5, 1]},
        "stimulus.dispersions.low.value[2]",
        ["found 0.5", "a whole number, >= 0"],
    ),
    "negative row": (
        {"stimulus": {**yaml.safe_load((DEVICES / "device3.yaml").read_text())["stimulus"]}}
        | {"stimulus.rows[1].absolute.value": -0.222},
        "stimulus.rows[1].absolute.value",
        ["found -0.222", ">= 0", "(displacement common to all actuators)"],
    ),
    "two rows of one phase": (
        {"stimulus": yaml.safe_load((DEVICES / "device3.yaml").read_text())["stimulus"]}
        | {"stimulus.rows[1].phase.value": 0},
        "stimulus",
        ["condition names must differ", "alternate_000"],
    ),
    "history with a hole": (
        {"stimulus": HISTORY, "stimulus.histories.tap.normal.value": [[0, 0, 0, 0], [0, 0, NAN, 0]]},
        "stimulus.histories.tap.normal.value[1][2]",
        ["found .nan", "a finite number, >= -10, <= 10", "(displacement into the skin"],
    ),
    "history with a short row": (
        {"stimulus": HISTORY, "stimulus.histories.tap.tangential.value": [[0, 0, 0, 0], [0, 0, 0]]},
        "stimulus.histories.tap.tangential",
        ["found 3 in row 2; allowed: 4 numbers, one for each actuator"],
    ),
    "history with a missing row": (
        {"stimulus": HISTORY, "stimulus.histories.tap.normal.value": [[0, 0, 0, 0]]},
        "stimulus",
        ["condition tap", "normal: found the shape (1, 4); allowed: 2 rows, one for each time"],
    ),
    "history back in time": (
        {"stimulus": HISTORY, "stimulus.histories.tap.time.value": [1.0, 0.5]},
        "stimulus",
        ["condition tap", "times must ascend, found 1 s before 0.5 s"],
    ),
    "history without a key": (
        {"stimulus": HISTORY, "stimulus.histories.tap.time": DELETED},
        "stimulus.histories.tap.time",
        ["found nothing", "(ascending times of the rows)"],
    ),
    "history that is no name": (
        {"stimulus": {"kind": "history", "histories": {"../tap": TAP}}},
        "stimulus.histories",
        ["the name ../tap", "small letters", "did you mean tap?"],
    ),
}

UNITS = [  # key, what is found, what was meant
    ("finger.width", (16000, "um"), (16.0, "mm")),
    ("finger.width", (16000, "\N{GREEK SMALL LETTER MU}m"), (16.0, "mm")),
    ("finger.width", (16000, "\N{MICRO SIGN}m"), (16.0, "mm")),
    ("finger.width", (1.6, "cm"), (16.0, "mm")),
    ("finger.width", (0.016, "m"), (16.0, "mm")),
    ("finger.pad[2].modulus", (80, "kPa"), (0.08, "MPa")),
    ("finger.pad[2].modulus", (8.0e4, "Pa"), (0.08, "MPa")),
    ("finger.dorsal[0].modulus", (0.17, "GPa"), (170.0, "MPa")),
]

TEXTS = {  # what the file holds, and what the message must say
    "nothing": (b"", ["a mapping of keys", "found an empty file"]),
    "only a comment": (b"# finger\n", ["found an empty file"]),
    "a list": (b"- finger\n", ["a mapping of keys", "found the list ['finger']"]),
    "a number": (b"3\n", ["found the int 3"]),
    "an open bracket": (b"finger: [1,\n", ["not valid YAML", "line 2"]),
    "a tab": (b"finger:\n\twidth: 3\n", ["not valid YAML", "line 2, column 1", "'\\t'", "indent with spaces"]),
    "a key twice": (b"finger: 1\ncontact: 2\nfinger: 3\n", ["line 3", "'finger' twice", "line 1", "allowed once"]),
    "an inner key twice": (b"finger: {width: 1, 'width': 2}\n", ["line 1, column 20", "'width' twice"]),
    "two documents": (b"a: 1\n---\nb: 2\n", ["not valid YAML", "another document"]),
    "an impossible date": (b"a: 2022-13-45\n", ["not valid YAML", "month"]),
    "Latin-1": ("finger: µm\n".encode("latin-1"), ["UTF-8", "found byte 0xb5"]),
    "a null byte": (b"finger: \x00\n", ["not valid YAML"]),
}


@pytest.mark.parametrize("name", ["device1", "device2", "device3"])
def test_shipped_devices_pass(name: str) -> None:
    scene = check_device(DEVICES / f"{name}.yaml", SCHEMAS, CONFIG)
    assert scene.device.name == name
    assert scene.model == check_config(CONFIG, SCHEMAS)


def test_a_device_has_friction_and_preload_of_its_own(tmp_path: Path) -> None:
    """What its file leaves out is the model's; what is varied is the device's own where it has one."""
    shared = check_config(CONFIG, SCHEMAS).contact
    document = yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8"))
    own = {"friction": quantity(0.3, "1"), "criterion": quantity("force", "1"), "force": quantity(0.05, "N/mm")}
    path = write(tmp_path, "mine.yaml", edited(document, {"contact": own}))
    scene = check_device(path, SCHEMAS, CONFIG)
    assert scene.model.contact == replace(shared, friction=0.3, criterion=Criterion.FORCE, force=0.05)
    assert load_scene(CONFIG, path).model == scene.model
    varied = check_device(path, SCHEMAS, CONFIG, {"contact.friction": 0.9, "contact.depth": 0.7})
    assert varied.model.contact == replace(scene.model.contact, friction=0.9, depth=0.7)

    for key, change, said in (
        ("contact.frcition", {"contact": {"frcition": quantity(0.3, "1")}}, "did you mean friction?"),
        (
            "contact.turning_normal",
            {"contact.turning_normal": quantity("never", "1")},
            "friction, criterion, depth, force",
        ),
        ("contact.force.unit", {"contact.force": quantity(0.1, "N")}, "allowed: N/mm"),
        ("contact.friction.value", {"contact.friction": quantity(-0.3, "1")}, "0, or a finite number"),
    ):
        message = message_of(write(tmp_path, "mine.yaml", edited(document, {"contact": own} | change)))
        assert message.startswith(f"{path}: {key}: found ")
        assert said in message


def test_a_row_may_be_uneven_and_lie_beside_the_middle(tmp_path: Path) -> None:
    """Positions take the place of count and pitch, to the last bit; the offset moves either to the right."""
    document = yaml.safe_load((DEVICES / "device2.yaml").read_text(encoding="utf-8"))
    even = check_device(DEVICES / "device2.yaml", SCHEMAS, CONFIG).device.actuators.positions

    def row(positions: list[float] | None, offset: float | None) -> tuple[float, ...]:
        edits: Edits = {"actuators.offset": DELETED if offset is None else quantity(offset, "mm")}
        if positions is not None:
            edits |= {"actuators.count": DELETED, "actuators.pitch": DELETED}
            edits |= {"actuators.positions": quantity(positions, "mm")}
        path = write(tmp_path, "mine.yaml", edited(document, edits))
        return check_device(path, SCHEMAS, CONFIG).device.actuators.positions

    assert row([-3.75, -1.25, 1.25, 3.75], None) == row(None, None) == even
    assert row(None, 0.5) == tuple(x + 0.5 for x in even)
    assert row([-3.0, -1.0, 1.5, 3.0], -0.25) == (-3.25, -1.25, 1.25, 2.75)
    assert row([0.0, 2.1, 4.2, 6.3], -3.15) == (-3.15, -1.05, 1.05, 3.15)  # rounding does not keep it from mirroring


def test_history_passes(tmp_path: Path) -> None:
    document = yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8"))
    scene = check_device(write(tmp_path, "tapper.yaml", edited(document, {"stimulus": HISTORY})), SCHEMAS, CONFIG)
    assert [condition.name for condition in scene.device.conditions] == ["tap"]
    assert scene.device.conditions[0].normal[1, 3] == 0.02


@pytest.mark.parametrize(("edits", "key", "parts"), CONFIG_MISTAKES.values(), ids=CONFIG_MISTAKES)
def test_mistake_in_config(tmp_path: Path, edits: Edits, key: str, parts: list[str]) -> None:
    document = edited(yaml.safe_load(CONFIG.read_text(encoding="utf-8")), edits)
    path = write(tmp_path, "config.yaml", document)
    message = message_of(path, device=False)
    assert f"{path}: {key}: " in message
    assert [part for part in parts if part not in message] == []
    assert all(line.startswith(f"{path}: ") for line in message.splitlines())


@pytest.mark.parametrize(
    ("stimulus", "parts"),
    [
        ({"dispersions": {1: [0, 1, 0, 1]}}, ["dispersions: found the name 1", "dispersions.1: found [0, 1, 0, 1]"]),
        (
            {"kind": "measured", "recordings": {90: "tap.csv"}},
            ["recordings: found the name 90", "recordings.90: found tap.csv"],
        ),
        (
            {"kind": "history", "histories": {1: {"phase": 0}}},
            ["histories: found the name 1", "histories.1.time: found nothing"],
        ),
    ],
)
def test_a_mistake_under_a_name_that_is_a_number(tmp_path: Path, stimulus: dict[str, Any], parts: list[str]) -> None:
    """Both are told: YAML's numbers are no places in a list."""
    document = yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8"))
    document["stimulus"] = stimulus if "kind" in stimulus else document["stimulus"] | stimulus
    message = message_of(write(tmp_path, "mine.yaml", document))
    assert [part for part in parts if f"stimulus.{part}" not in message] == [], message


@pytest.mark.parametrize(("edits", "key", "parts"), DEVICE_MISTAKES.values(), ids=DEVICE_MISTAKES)
def test_mistake_in_device(tmp_path: Path, edits: Edits, key: str, parts: list[str]) -> None:
    document = edited(yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8")), edits)
    path = write(tmp_path, "mine.yaml", document)
    message = message_of(path)
    assert message.startswith(f"{path}: {key}: ")
    assert [part for part in parts if part not in message] == []
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(("key", "found", "meant"), UNITS)
def test_wrong_unit_is_converted(tmp_path: Path, key: str, found: tuple[float, str], meant: tuple[float, str]) -> None:
    document = edited(yaml.safe_load(CONFIG.read_text(encoding="utf-8")), {key: quantity(*found)})
    message = message_of(write(tmp_path, "config.yaml", document), device=False)
    hint = f"did you mean {{value: {meant[0]}, unit: {meant[1]}}}?"
    assert f"{key}.unit: found {found[1]}; allowed: {meant[1]}; {hint} (" in message.splitlines()[0]


def test_wrong_unit_of_a_list_is_converted(tmp_path: Path) -> None:
    document = yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8"))
    edits = {"stimulus.phases": quantity([0, 3.141592653589793], "rad")}
    message = message_of(write(tmp_path, "mine.yaml", edited(document, edits)))
    assert "stimulus.phases.unit: found rad; allowed: deg; did you mean {value: [0.0, 180.0], unit: deg}?" in message


@pytest.mark.parametrize("name", ["config", "device1", "device3"])
def test_not_a_number_is_found_everywhere(tmp_path: Path, name: str) -> None:
    file = CONFIG if name == "config" else DEVICES / f"{name}.yaml"
    document = yaml.safe_load(file.read_text(encoding="utf-8"))
    keys = list(leaves(document))
    assert len(keys) > 30
    for key in keys:
        message = message_of(write(tmp_path, file.name, edited(document, {key: NAN})), device=file is not CONFIG)
        assert f": {key}: found .nan; allowed: " in message


@pytest.mark.parametrize(("text", "parts"), TEXTS.values(), ids=TEXTS)
@pytest.mark.parametrize("device", [False, True], ids=["config", "device"])
def test_file_that_is_no_scene_file(tmp_path: Path, text: bytes, parts: list[str], device: bool) -> None:
    path = tmp_path / "mine.yaml"
    path.write_bytes(text)
    message = message_of(path, device)
    assert message.startswith(f"{path}: ")
    assert [part for part in parts if part not in message] == []
    assert len(message.splitlines()) == 1


def test_file_that_cannot_be_read(tmp_path: Path) -> None:
    assert "No such file" in message_of(tmp_path / "absent.yaml", device=False)
    assert f"{tmp_path}: " in message_of(tmp_path, device=False)
    assert "s a directory" in message_of(tmp_path, device=False)


def test_wrong_config_is_reported_for_a_device(tmp_path: Path) -> None:
    config = tmp_path / "config.yaml"
    config.write_text("")
    with pytest.raises(SceneError, match=re.escape(f"{config}: ") + ".*an empty file"):
        check_device(DEVICES / "device1.yaml", SCHEMAS, config)


def test_most_fundamental_mistake_comes_first(tmp_path: Path) -> None:
    edits = {"contact.friction.value": -1, "filter.sigma.value": "wide", "numerics.max_cuts": DELETED}
    document = edited(yaml.safe_load(CONFIG.read_text(encoding="utf-8")), edits)
    lines = message_of(write(tmp_path, "config.yaml", document), device=False).splitlines()
    keys = [line.split(": ")[1] for line in lines]
    assert keys == ["numerics.max_cuts", "filter.sigma.value", "contact.friction.value"]


def test_many_mistakes_are_cut(tmp_path: Path) -> None:
    document = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
    edits = {f"numerics.{key}.value": -1 for key in document["numerics"]}
    lines = message_of(write(tmp_path, "config.yaml", edited(document, edits)), device=False).splitlines()
    assert len(lines) == MOST_REPORTED + 1
    assert lines[-1].endswith(f": and {len(edits) - MOST_REPORTED} more")


def test_long_values_are_cut(tmp_path: Path) -> None:
    document = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
    path = write(tmp_path, "config.yaml", edited(document, {"contact": list(range(1000))}))
    assert f"{path}: contact: found [0, 1, 2" in (message := message_of(path, device=False))
    assert len(message) - len(str(path)) < 250


def test_numbers_are_what_people_take_them_for() -> None:
    """Leading zeros and exponents as in YAML 1.2; a phase of 045 degrees is no octal number."""
    assert read_values("045, -010, 1e-3, 2E2, +.5, 5.") == [45, -10, 1e-3, 200.0, 0.5, 5.0]
    assert read_values("0x1F, 1_000, 1:30, 1e, .") == ["0x1F", "1_000", "1:30", "1e", "."]


def test_known_devices() -> None:
    assert {"device1", "device2", "device3"} <= set(known_devices(DEVICES))
    assert require_device("device2", DEVICES) == DEVICES / "device2.yaml"


def test_unknown_device(tmp_path: Path) -> None:
    for name in ("rough", "smooth"):
        (tmp_path / f"{name}.yaml").touch()
    (tmp_path / ".hidden.yaml").touch()
    (tmp_path / "notes.txt").touch()
    assert known_devices(tmp_path) == ["rough", "smooth"]
    with pytest.raises(SceneError) as caught:
        require_device("smoth", tmp_path)
    message = str(caught.value)
    parts = [f"{tmp_path}: device: ", "found smoth", "allowed: rough, smooth", "did you mean smooth?"]
    assert [part for part in parts if part not in message] == []


def test_no_devices(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="found device1, which has no file; allowed: none"):
        require_device("device1", tmp_path)
    with pytest.raises(SceneError, match="is not a folder"):
        known_devices(tmp_path / "absent")


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("Device-4.yaml", "device_4.yaml"),
        ("my device.yaml", "my_device.yaml"),
        ("4pins.yaml", "pins.yaml"),
        ("a.b.yaml", "a_b.yaml"),
        ("device4.yml", "device4.yaml"),
    ],
)
def test_file_name_that_is_no_device_name(tmp_path: Path, name: str, meant: str) -> None:
    path = tmp_path / name
    path.write_bytes((DEVICES / "device1.yaml").read_bytes())
    for act in (lambda: known_devices(tmp_path), lambda: check_device(path, SCHEMAS, CONFIG)):
        with pytest.raises(SceneError) as caught:
            act()
        message = str(caught.value)
        parts = [f"{path}: file name: found {name}", "small letters", f"did you mean {meant}?"]
        assert [part for part in parts if part not in message] == []


@pytest.mark.parametrize("name", ["nan", "null", "inf", "infinity", "true", "false"])
def test_device_that_tables_would_take_for_something_else(tmp_path: Path, name: str) -> None:
    (tmp_path / f"{name}.yaml").write_bytes((DEVICES / "device1.yaml").read_bytes())
    other = "a name other than false, inf, infinity, nan, null, true"
    with pytest.raises(SceneError, match=f"file name: found {name}.yaml; allowed: {other}, then .yaml"):
        known_devices(tmp_path)
    with pytest.raises(SceneError, match=f"NAME: found {name}; allowed: {other}"):
        require_new_name(name)
    column = pd.read_csv(io.StringIO(f"device\n{name}\n"))["device"]
    assert column.to_list() != [name]


def subschemas(node: Any) -> Iterator[dict[str, Any]]:
    """All mappings in a schema."""
    if isinstance(node, dict):
        yield node
    for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from subschemas(child)


@pytest.mark.parametrize("name", ["config", "device"])
def test_schemas_are_closed_and_described(name: str) -> None:
    files = {path.name: yaml.safe_load(path.read_text(encoding="utf-8")) for path in SCHEMAS.glob("*.schema.yaml")}
    schema = files[f"{name}.schema.yaml"]
    Draft202012Validator.check_schema(schema)
    nodes = list(subschemas(schema))
    described, units = 0, 0
    for node in nodes:
        if node.get("type") == "object" and "allOf" not in node:  # with allOf, the branch of the kind is closed
            assert "additionalProperties" in node, node
        if node.get("$ref") == "#/$defs/quantity":
            assert set(node["properties"]) == {"value", "unit"}, node
            assert "const" in node["properties"]["unit"], node
            units += 1
        for key, child in node.get("properties", {}).items() if isinstance(node.get("properties"), dict) else ():
            if isinstance(child, dict) and key not in ("value", "unit", "source") and "const" not in child:
                file, _, way = child.get("$ref", "").partition("#/")
                parts = way.split("/") if way else []
                target = functools.reduce(operator.getitem, parts, files[file] if file else schema)
                assert "description" in child or "description" in target, key
                described += 1
    assert units > 10
    assert described > 15


def test_a_preload_may_be_idle_where_the_criterion_is_varied(tmp_path: Path) -> None:
    own = {"contact": {"criterion": quantity("depth", "1"), "depth": quantity(0.5, "mm")}}
    document = edited(yaml.safe_load((DEVICES / "device1.yaml").read_text(encoding="utf-8")), own)
    scene = check_device(write(tmp_path, "mine.yaml", document), SCHEMAS, CONFIG, {"contact.criterion": "touch"})
    assert scene.model.contact.criterion == "touch"


@pytest.mark.parametrize(("allowed", "unit", "value"), [("s", "ms", 5e-3), ("1", "%", 0.05)])
def test_milliseconds_and_percent_are_converted(allowed: str, unit: str, value: float) -> None:
    assert _meant_unit(allowed, unit, {"value": 5.0}) == f"{{value: {value}, unit: {allowed}}}"


def test_as_many_mistakes_as_are_told_are_not_cut(tmp_path: Path) -> None:
    document = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
    edits = {f"numerics.{key}.value": -1 for key in list(document["numerics"])[:MOST_REPORTED]}
    lines = message_of(write(tmp_path, "config.yaml", edited(document, edits)), device=False).splitlines()
    assert len(lines) == MOST_REPORTED


def test_the_longest_name_is_one() -> None:
    require_new_name("a" * LONGEST_NAME)
    with pytest.raises(SceneError, match=f"at most {LONGEST_NAME}"):
        require_new_name("a" * (LONGEST_NAME + 1))


def test_laws_refuse_what_is_out_of_range_and_take_no_friction() -> None:
    given = scene("device2").model
    assert replace(given.contact, friction=0.0).coefficient(Interface.SHEAR) == 0.0
    for wrong in (0.0, -1.0):
        with pytest.raises(SceneError, match="force"):
            replace(given.contact, force=wrong)
    with pytest.raises(SceneError, match="ogden_exponent must be a number other than 0"):
        replace(given.tissue, ogden_exponent=0.0)


def test_limits_in_code_are_those_of_the_schemas() -> None:
    """A device's name is that of its file and a frequency may be an option: these no schema sees."""
    config, device = (
        yaml.safe_load((SCHEMAS / f"{name}.schema.yaml").read_text(encoding="utf-8"))["$defs"]
        for name in ("config", "device")
    )
    name, frequency = config["name"], device["frequencies"]["properties"]["value"]["items"]
    assert name["maxLength"] == LONGEST_NAME
    names = re.search(r"\?!\(([a-z|]+)\)", name["pattern"])
    assert names and set(names[1].split("|")) == RESERVED | {"value", "source"}  # which a quantity has
    assert (frequency["minimum"], frequency["maximum"]) == (LOWEST, HIGHEST)
