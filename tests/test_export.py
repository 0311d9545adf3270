"""The input deck: what it says of mesh, layers, actuators, contact and steps, and the command that writes it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.calculix.crosscheck import sharpened
from fingerpad.calculix.deck import FRICTIONLESS, READ_NODES, DeckSettings, input_deck, read_nodes
from fingerpad.cli import FAILED, main
from fingerpad.contact.profile import profile
from fingerpad.errors import SceneError
from fingerpad.prediction.edges import mesh_device
from fingerpad.scene.contact_law import FrictionFrom, Interface
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics, Law
from scenes import CONFIG, DECK, scene, section

SCHEMAS = Path(__file__).parents[1] / "workflow" / "schemas"
CONDITION = "alternate_180"
WRITTEN = 1e-11  # of a number [1]; source: decks have twelve digits of it
SIDES = {3: ((0, 3, 1), (1, 4, 2), (2, 5, 0)), 4: ((0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0))}  # by corners

Block = tuple[str, dict[str, str], list[list[str]]]  # keyword, its parameters, its data lines


@cache
def deck(device: str) -> list[Block]:
    return parsed(scene(device), DECK)


def parsed(a_scene: Scene, settings: DeckSettings) -> list[Block]:
    """Keywords of a deck in their order, each with parameters and data."""
    shipped = scene(a_scene.device.name)
    mesh = section(shipped.device.name) if a_scene.device is shipped.device else mesh_device(a_scene)
    text = input_deck(a_scene, mesh, a_scene.device.conditions[-1], settings)
    blocks: list[Block] = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        entries = [entry.strip() for entry in line.split(",")]
        if line.startswith("*"):
            pairs = (entry.partition("=") for entry in entries[1:])
            blocks.append((entries[0][1:], {key.strip(): value.strip() for key, _, value in pairs}, []))
        else:
            blocks[-1][2].append(entries)
    return blocks


def of_kind(blocks: list[Block], keyword: str) -> list[Block]:
    return [block for block in blocks if block[0] == keyword]


def nodes(blocks: list[Block]) -> dict[int, FloatArray]:
    return {int(n): np.array([float(x), float(y)]) for _, _, rows in of_kind(blocks, "NODE") for n, x, y in rows}


def elements(blocks: list[Block]) -> dict[int, list[int]]:
    return {int(row[0]): [int(n) for n in row[1:]] for _, _, rows in of_kind(blocks, "ELEMENT") for row in rows}


def node_set(blocks: list[Block], name: str) -> np.ndarray:
    rows = next(rows for _, given, rows in of_kind(blocks, "NSET") if given["NSET"] == name)
    return np.array([int(n) for row in rows for n in row])


def surface(blocks: list[Block], name: str) -> FloatArray:
    """Points (n_faces, 3, 2) of a surface: end, middle, end of every face."""
    rows = next(rows for _, given, rows in of_kind(blocks, "SURFACE") if given["NAME"] == name)
    point, element = nodes(blocks), elements(blocks)
    found = []
    for number, side in rows:
        members = element[int(number)]
        found.append([point[members[k]] for k in SIDES[len(members) // 2][int(side[1:]) - 1]])
    return np.array(found)


@pytest.mark.parametrize(("radius", "fits"), [(0.0, True), (0.15, True), (0.2, False)])
def test_edges_deeper_than_a_deformable_body_is_thick_are_refused(radius: float, fits: bool) -> None:
    """Of a circle up to 75 degrees and a wall from there on: 0.87 times the radius, here of 0.15 mm."""
    given = scene("device3")
    given = given.with_device(actuators=replace(given.device.actuators, edge_radius=radius))
    if fits:
        assert of_kind(parsed(given, DECK), "ELEMENT")
    else:
        with pytest.raises(SceneError, match=r"0\.17 mm deep on a deformable body 0\.15 mm thick"):
            parsed(given, DECK)


@pytest.mark.parametrize("acting", [0.0, 0.3])
def test_deck_whose_friction_falls_after_pre_indentation_is_refused(acting: float) -> None:
    with pytest.raises(SceneError, match="friction that indents must act too"):
        replace(DECK, friction_indenting=0.6, friction_acting=acting)


@pytest.mark.parametrize("name", ["height", "friction_indenting", "friction_acting", "rest_increments"])
@pytest.mark.parametrize("value", [-1, float("nan"), float("inf")])
def test_deck_of_numbers_that_are_none_is_refused(name: str, value: float) -> None:
    with pytest.raises(SceneError, match=f"deck: {name.replace('_', ' ')} must be finite and not negative"):
        replace(DECK, **{name: value})


def test_skin_of_close_pins_is_that_of_one_of_them_each() -> None:
    """Four pins with gaps of a few elements, coarsely meshed: surfaces join without a gap, and mirror."""
    base = scene("device2")
    row = replace(base.device.actuators, positions=(-0.825, -0.275, 0.275, 0.825), width=0.5)
    close = base.with_device(actuators=row).coarsened(4.0)
    blocks = parsed(close, DECK)
    skins = [surface(blocks, f"SKIN_{number}")[:, :, 0] for number in range(1, 5)]
    ends = np.array([[skin.min(), skin.max()] for skin in skins])
    np.testing.assert_array_equal(ends[1:, 0], ends[:-1, 1])
    np.testing.assert_array_equal(ends, -ends[::-1, ::-1])
    assert [len(skin) for skin in skins] == [len(skin) for skin in skins[::-1]]


@pytest.mark.parametrize("device", ["device1", "device2", "device3"])
def test_every_element_is_counter_clockwise_with_its_midpoints_in_place(device: str) -> None:
    point = nodes(deck(device))
    for members in elements(deck(device)).values():
        corners = len(members) // 2
        x = np.array([point[n] for n in members])
        ring, following = x[:corners], np.roll(x[:corners], -1, axis=0)
        assert np.sum(ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]) > 0.0
        length = np.linalg.norm(following - ring, axis=1)
        # source: a second-order side maps one to one while its midpoint is within a quarter of its middle
        assert np.all(np.linalg.norm(x[corners:] - (ring + following) / 2.0, axis=1) < 0.25 * length)


def test_the_finger_is_the_section_mesh() -> None:
    mesh, blocks = section("device2"), deck("device2")
    point = nodes(blocks)
    count = mesh.mesh.doflocs.shape[1]
    assert np.allclose([point[n + 1] for n in range(count)], mesh.mesh.doflocs.T, rtol=WRITTEN, atol=0.0)
    assert np.array_equal(node_set(blocks, "BONE"), mesh.fixed + 1)
    assert np.array_equal(node_set(blocks, READ_NODES), read_nodes(scene("device2"), mesh) + 1)
    layers = [b for b in of_kind(blocks, "ELEMENT") if b[1]["ELSET"].startswith("LAYER_")]
    assert [len(rows) for _, _, rows in layers] == np.bincount(mesh.layer).tolist()
    assert [given["ELSET"].split("_", 2)[2].lower() for _, given, _ in layers] == [
        layer.name for layer in scene("device2").model.finger.layers
    ]


def test_every_layer_has_its_material() -> None:
    blocks, finger = deck("device2"), scene("device2").model.finger
    sections = {given["ELSET"]: given["MATERIAL"] for _, given, _ in of_kind(blocks, "SOLID SECTION")}
    assert sections.keys() == {given["ELSET"] for _, given, _ in of_kind(blocks, "ELEMENT")}
    names = [given["NAME"] for _, given, _ in of_kind(blocks, "MATERIAL")]
    constants = dict(zip(names, (rows[0] for _, _, rows in of_kind(blocks, "ELASTIC")), strict=True))
    for index, layer in enumerate(finger.layers):
        found = [float(value) for value in constants[sections[f"LAYER_{index + 1}_{layer.name.upper()}"]]]
        assert found == [layer.material.modulus, layer.material.poisson]


@cache
def finite_deck(law: Law) -> list[Block]:
    base = scene("device3")
    tissue = replace(base.model.tissue, kinematics=Kinematics.FINITE, law=law, ogden_exponent=9.0)
    return parsed(base.with_model(tissue=tissue), DECK)


@pytest.mark.parametrize("law", list(Law))
def test_finite_kinematics_are_nlgeom_in_every_step(law: Law) -> None:
    steps = of_kind(finite_deck(law), "STEP")
    assert len(steps) == 5
    assert all("NLGEOM" in given for _, given, _ in steps)
    assert not any("NLGEOM" in given for _, given, _ in of_kind(deck("device3"), "STEP"))


@pytest.mark.parametrize("law", list(Law))
def test_skin_has_the_law_and_the_stiffness_that_it_starts_with(law: Law) -> None:
    """Shear modulus 2 C10 or mu, bulk modulus 2/D1; nail, nail bed and actuators stay as they are."""
    finger = scene("device3").model.finger
    blocks = finite_deck(law)
    start = next(k for k, block in enumerate(blocks) if block[0] == "MATERIAL")
    found = [block for block in blocks[start:] if block[0] in ("ELASTIC", "HYPERELASTIC")]
    others = 1 + len(finger.dorsal)
    assert all(keyword == "ELASTIC" for keyword, _, _ in found[-others:])
    for layer, (keyword, given, rows) in zip(finger.pad, found[:-others], strict=True):
        values = [float(value) for value in rows[0]]
        if law in (Law.GREEN, Law.HENCKY):
            assert (keyword, values) == ("ELASTIC", [layer.material.modulus, layer.material.poisson])
            continue
        shear, bulk = layer.material.modulus / np.array(
            [2.0 * (1.0 + layer.material.poisson), 3.0 * (1.0 - 2.0 * layer.material.poisson)]
        )
        assert keyword == "HYPERELASTIC"
        if law is Law.NEO_HOOKEAN:
            assert "NEO HOOKE" in given
            assert values == pytest.approx([shear / 2.0, 2.0 / bulk], rel=WRITTEN)
        else:
            assert (given["OGDEN"], given["N"]) == ("", "1")
            assert values == pytest.approx([shear, 9.0, 2.0 / bulk], rel=WRITTEN)


@pytest.mark.parametrize("device", ["device2", "device3"])
def test_faces_follow_the_profile(device: str) -> None:
    """But for digits that x lacks: of 5 mm, times the steepest slope of an edge, less than 4."""
    row = scene(device).device.actuators
    for number, centre in enumerate(row.positions):
        faces = surface(deck(device), f"ACTUATOR_{number + 1}_FACE").reshape(-1, 2)
        x = faces[:, 0] - centre
        top = np.abs(x) < row.width / 2.0  # the sides of a deformable body go down from there
        assert np.allclose(faces[top, 1], -profile(row, x[top])[0], rtol=0.0, atol=5.0 * 4.0 * WRITTEN)
        assert x.max() >= row.width / 2.0 - row.edge_radius


def test_a_sharp_edge_ends_the_face() -> None:
    sharp = sharpened(scene("device2"))
    faces = surface(parsed(sharp, DECK), "ACTUATOR_1_FACE").reshape(-1, 2)
    centre, half = sharp.device.actuators.positions[0], sharp.device.actuators.width / 2.0
    assert np.all(faces[:, 1] == 0.0)
    assert [faces[:, 0].min(), faces[:, 0].max()] == pytest.approx([centre - half, centre + half], rel=WRITTEN)


def test_skin_surfaces_lie_on_the_skin_each_near_its_actuator() -> None:
    mesh, positions = section("device2"), np.asarray(scene("device2").device.actuators.positions)
    skin = {tuple(point) for point in mesh.mesh.doflocs[:, mesh.skin].T.round(9)}
    for number in range(positions.size):
        faces = surface(deck("device2"), f"SKIN_{number + 1}")
        assert {tuple(point) for point in faces.reshape(-1, 2).round(9)} <= skin
        assert np.all(np.argmin(np.abs(faces[:, 1, [0]] - positions), axis=1) == number)
        assert np.ptp(faces[:, :, 0]) > scene("device2").device.actuators.width


def test_a_deformable_actuator_is_driven_at_its_base() -> None:
    blocks, row = deck("device3"), scene("device3").device.actuators
    assert row.body is not None
    point = nodes(blocks)
    for number, centre in enumerate(row.positions):
        base = np.array([point[n] for n in node_set(blocks, f"ACTUATOR_{number + 1}")])
        assert np.allclose(base[:, 1], -row.body.thickness, rtol=WRITTEN, atol=0.0)
        assert np.ptp(base[:, 0]) == pytest.approx(row.width, rel=WRITTEN)
        assert base[:, 0].mean() == pytest.approx(centre, rel=WRITTEN)


def test_steps_move_the_actuators_along_the_condition() -> None:
    condition = scene("device2").device.condition(CONDITION)
    _, still, *moves = [b[2] for b in of_kind(deck("device2"), "BOUNDARY")]  # the first holds the bone
    assert all(float(row[3]) == 0.0 for row in still)
    assert len(moves) == 2 * (1 + condition.time.size)  # each is followed by a rest
    values = np.array([[float(row[3]) for row in rows] for rows in moves]).reshape(len(moves), -1, 2)
    indented = np.array([0.0, DECK.height])
    stimulus = np.stack([condition.tangential, condition.normal], axis=-1)[0]
    wanted = [np.tile(indented, (4, 1)), indented + stimulus]
    assert np.allclose(values, [wanted[0], wanted[0], wanted[1], wanted[1]], rtol=WRITTEN, atol=0.0)


@pytest.mark.parametrize(
    ("indenting", "acting", "first", "switched"), [(0.0, 0.0, None, None), (0.6, 0.6, 0.6, None), (0.0, 0.6, 0.0, 0.6)]
)
def test_friction_acts_from_where_it_is_asked(
    indenting: float, acting: float, first: float | None, switched: float | None
) -> None:
    blocks = parsed(scene("device2"), replace(DECK, friction_indenting=indenting, friction_acting=acting))
    found = [float(rows[0][0]) for _, _, rows in of_kind(blocks, "FRICTION")]
    assert found == pytest.approx(
        [value for value in (first, switched) if value is not None], rel=WRITTEN, abs=FRICTIONLESS
    )
    keywords = [keyword for keyword, _, _ in blocks]
    assert keywords.count("CHANGE FRICTION") == (0 if switched is None else 1)
    if switched is not None:
        assert keywords[: keywords.index("CHANGE FRICTION")].count("STEP") == 4  # still, indented, at rest, stimulus


def test_without_rest_every_move_is_one_step() -> None:
    blocks = parsed(scene("device2"), replace(DECK, rest_increments=0))
    assert len(of_kind(blocks, "STEP")) == 3  # the first moves nothing


def test_the_first_step_prints_nothing() -> None:
    """What is read is the end of every move; the first step is there for CalculiX alone."""
    blocks = deck("device2")
    ends = [number for number, (keyword, _, _) in enumerate(blocks) if keyword == "END STEP"]
    assert "NODE PRINT" not in [keyword for keyword, _, _ in blocks[: ends[0]]]
    assert "NODE PRINT" in [keyword for keyword, _, _ in blocks[ends[0] : ends[1]]]


def export(tmp_path: Path, condition: str) -> list[str]:
    device = CONFIG / "devices" / "device2.yaml"
    given = ["--condition", condition, "--interface", str(Interface.SHEAR), "-o", str(tmp_path / "scene.inp")]
    return ["export", str(device), "--config", str(CONFIG / "config.yaml"), "--schemas", str(SCHEMAS), *given]


def test_command_writes_a_deck(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(export(tmp_path, CONDITION)) == 0
    assert capsys.readouterr().out == f"written: {tmp_path / 'scene.inp'}. Small strains (no NLGEOM).\n"
    text = (tmp_path / "scene.inp").read_text(encoding="utf-8")
    assert text.startswith("*HEADING\n")
    assert text.count("*END STEP") == 5


def test_a_title_is_no_keyword() -> None:
    """CalculiX would take a title that begins with an asterisk for one."""
    given = scene("device2")
    titled = given.with_device(title="*STEP")
    assert [keyword for keyword, _, _ in parsed(titled, DECK)] == [keyword for keyword, _, _ in parsed(given, DECK)]


def test_command_says_in_one_line_what_is_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(export(tmp_path, "backwards")) == FAILED
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "no condition 'backwards'" in said
    assert not (tmp_path / "scene.inp").exists()


@pytest.mark.parametrize("flag", ["--stick-slope", "--indentation-increments"])
def test_command_refuses_settings_that_make_no_deck(
    flag: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*export(tmp_path, CONDITION), flag, "0"]) == FAILED
    assert f"{flag[2:].replace('-', ' ')} must be positive" in capsys.readouterr().err


def test_steps_take_the_increments_that_are_asked_for() -> None:
    """Still, indented, at rest, stimulated, at rest."""
    settings = replace(DECK, indentation_increments=10, stimulus_increments=4, rest_increments=2)
    first = [float(rows[0][0]) for _, _, rows in of_kind(parsed(scene("device2"), settings), "STATIC")]
    assert first == pytest.approx([1.0, 1 / 10, 1 / 2, 1 / 4, 1 / 2])


def test_deck_is_indented_as_deep_as_with_the_friction_it_indents_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As the config says unless asked otherwise; the increments and slopes are those of --help."""
    seen: list[Any] = []
    monkeypatch.setattr("fingerpad.commands.export.mesh_device", lambda *_: None)
    monkeypatch.setattr(
        "fingerpad.commands.export.indented_height",
        lambda given, *_: seen.append(given.model.contact.friction_from) or 1.25,
    )
    monkeypatch.setattr("fingerpad.commands.export.input_deck", lambda *given: seen.append(given[-1]) or "")
    for more in ([], ["--friction-from", "stimulus"]):
        assert main([*export(tmp_path, CONDITION), *more]) == 0
    mu = scene("device2").model.contact.friction
    assert seen == [
        FrictionFrom.TOUCH,
        DeckSettings(1.25, mu, mu, 500.0, 100.0, 20, 4, 3),
        FrictionFrom.STIMULUS,
        DeckSettings(1.25, 0.0, mu, 500.0, 100.0, 20, 4, 3),
    ]
