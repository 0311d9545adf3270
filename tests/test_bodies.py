"""Bodies of actuators: the kinds that there are, and bodies of other shapes and on springs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from matplotlib.figure import Figure

from fingerpad.arrays import FloatArray
from fingerpad.calculix.deck import input_deck
from fingerpad.contact.linear_solution import indent_device
from fingerpad.contact.problem import contact_problem
from fingerpad.errors import MeshError, SceneError
from fingerpad.figures.actuators import draw_actuators
from fingerpad.scene.bodies import BODIES
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import Body
from fingerpad.scene.finger import Material
from fingerpad.scene.scene import Scene
from fingerpad.tissue.actuator_body import body_of
from scenes import DECK, condensed, scene, section

SCHEMA = Path(__file__).parents[1] / "workflow" / "schemas" / "device.schema.yaml"
SOFT = Material(1.0, 0.3)
FORCES = 1e-6  # of the largest [1]: forces follow gaps, known to 1e-9, a thousandfold


@dataclass(frozen=True)
class Flared(Body):
    """A puck that widens towards its base, to `flare` [1] times its face's width."""

    flare: float

    def placed(self, x: FloatArray, y: FloatArray) -> FloatArray:
        return np.stack([x * (1.0 - (self.flare - 1.0) * y / self.thickness), y])


@dataclass(frozen=True)
class Sprung(Body):
    """A puck on springs. along, into: stiffness [N/mm per mm]."""

    along: float
    into: float

    def mount(self) -> FloatArray:
        return np.diag([1.0 / self.along, 1.0 / self.into])


@dataclass(frozen=True)
class Leaning(Body):
    """A puck on a leaf spring that gives way along one direction, at `angle` [rad] to the face, by 0.5 mm per N/mm."""

    angle: float

    def mount(self) -> FloatArray:
        along = np.array([np.cos(self.angle), np.sin(self.angle)])
        return np.outer(along, along) / 2.0


def with_body(body: Body) -> Scene:
    """Device 3 with another body."""
    base = scene("device3")
    return base.with_device(actuators=replace(base.device.actuators, body=body))


def answers(body: Body) -> FloatArray:
    """Displacement (2k, 2) [mm] of the face under a uniform traction along x, and along y: 1 N/mm in all."""
    found = body_of(with_body(body))
    assert found is not None
    length = np.diff(found.coordinate[::2])
    share = np.zeros(found.coordinate.size)  # of the traction: 1/6, 4/6 and 1/6 of an element's at its nodes
    for first, part in ((0, 1.0), (1, 4.0), (2, 1.0)):
        share[first : first + 2 * length.size : 2] += part * length / 6.0
    return np.asarray(found.compliance @ np.kron(share[:, None] / length.sum(), np.eye(2)))


def test_kinds_are_those_of_the_schema() -> None:
    schema = yaml.safe_load(SCHEMA.read_text(encoding="utf-8"))
    body = schema["properties"]["actuators"]["properties"]["body"]
    assert body["properties"]["kind"]["enum"] == list(BODIES)
    branches = {
        case["if"]["properties"]["kind"]["const"]: case["then"]["$ref"].removeprefix("#/$defs/")
        for case in body["allOf"]
    }
    assert branches == {name: name for name in BODIES}


def test_springs_give_way_as_much_as_the_force_asks() -> None:
    """In series: what the puck gives, and force over stiffness, everywhere on the face."""
    beside = answers(Sprung(SOFT, 0.15, along=2.0, into=5.0)) - answers(Body(SOFT, 0.15))
    count = beside.shape[0] // 2
    assert beside == pytest.approx(np.tile(np.diag([0.5, 0.2]), (count, 1)), abs=1e-12)


def test_flared_puck_is_stiffer_than_a_strip_and_softer_than_a_wide_one() -> None:
    """Of three bodies with one face, that with more material gives less; a factor of 1 is the strip itself."""
    strip, same, flared = (answers(body) for body in (Body(SOFT, 1.0), Flared(SOFT, 1.0, 1.0), Flared(SOFT, 1.0, 1.5)))
    assert same == pytest.approx(strip, rel=1e-12, abs=1e-15)
    mean = np.array([[each[0::2, 0].mean(), each[1::2, 1].mean()] for each in (strip, flared)])
    assert np.all(mean[1] < mean[0])


def test_tall_tapered_puck_is_a_tapered_bar() -> None:
    """Pressed, with Poisson's ratio 0, the base of a tall trapezoid gives way as a bar of linear width b(y) does:
    F t ln(b/a) / (E a (b/a - 1)) with a, b the widths of face and base; a bar neglects the square of the sides' slope,
    0.075.
    """
    thickness, flare = 3.0, 1.3
    width = scene("device3").device.actuators.width
    found = answers(Flared(Material(1.0, 0.0), thickness, flare))
    bar = thickness * np.log(flare) / (width * (flare - 1.0))
    middle = found[1::2, 1].mean()
    assert middle == pytest.approx(bar, rel=0.01)


@pytest.mark.parametrize(
    "body", [Flared(SOFT, 0.3, 1.4), Sprung(SOFT, 0.15, 50.0, 50.0)], ids=lambda body: type(body).__name__
)
def test_they_are_pressed_onto_the_finger(body: Body) -> None:
    """A certified state, in which the actuators bear what they press."""
    other = with_body(body)
    skin, _ = condensed("device3")
    (interface, *_) = other.device.interfaces()
    state = indent_device(other, skin, body_of(other), interface).state
    assert state.force[:, 1].sum() > 0.0
    assert state.residual <= other.model.numerics.newton_tolerance


def test_bodies_that_lean_press_as_their_mirror_image_does() -> None:
    """A row of pucks that all lean one way does not mirror, but leaning the other way it bears the mirrored forces."""
    skin, _ = condensed("device3")

    def forces(angle: float) -> FloatArray:
        other = with_body(Leaning(SOFT, 0.15, angle))
        return indent_device(other, skin, body_of(other), Interface.SHEAR).state.force

    left, right = forces(np.pi / 6.0), forces(-np.pi / 6.0)
    mirrored = right[::-1] * [-1.0, 1.0]
    assert left == pytest.approx(mirrored, abs=FORCES * np.abs(left).max())
    assert np.abs(left - right).max() > 0.01 * np.abs(left).max()


def test_bodies_that_move_their_face_or_base_are_refused() -> None:
    @dataclass(frozen=True)
    class Moved(Body):
        def placed(self, x: FloatArray, y: FloatArray) -> FloatArray:
            return np.stack([x, y - 0.1])

    @dataclass(frozen=True)
    class Deeper(Body):
        def placed(self, x: FloatArray, y: FloatArray) -> FloatArray:
            return np.stack([x, 1.2 * y])

    with pytest.raises(MeshError, match="its face must lie where the strip's does"):
        body_of(with_body(Moved(SOFT, 0.15)))
    with pytest.raises(MeshError, match="and its base as deep"):
        body_of(with_body(Deeper(SOFT, 1.0 / 3.0)))  # which has more digits than the mesh keeps
    with pytest.raises(MeshError, match=r"actuator body: .* inverted elements"):
        body_of(with_body(Flared(SOFT, 0.15, -1.0)))


def test_decks_have_strips_alone() -> None:
    other = with_body(Flared(SOFT, 0.15, 1.2))
    with pytest.raises(
        SceneError, match="deck: found actuators of the kind Flared; allowed: rigid and deformable ones"
    ):
        input_deck(other, section("device3"), other.device.conditions[0], DECK)


def test_it_is_drawn_as_it_is() -> None:
    """Twice as wide at the base as at the face."""
    other = with_body(Flared(SOFT, 0.3, 2.0)).device.actuators
    axes = Figure().add_subplot()
    draw_actuators(axes, other, np.zeros((4, 2)), 1.0)
    outline = axes.patches[0].get_xy()
    assert np.ptp(outline[:, 0]) == pytest.approx(2.0 * other.width)
    assert outline[:, 1].min() == pytest.approx(-0.3)


@pytest.mark.parametrize(("modulus", "halved"), [(0.03, 0), (0.02, 1)])
def test_a_body_softer_than_the_tissue_is_pressed_with_hardly_an_increment_halved(modulus: float, halved: int) -> None:
    """Its face gives way by much, and elsewhere than foreseen. Tissue has 0.034 MPa: at three fifths of it one of some
    50 increments may be halved."""
    shipped = scene("device3").device.actuators.body
    assert shipped is not None
    soft = with_body(replace(shipped, material=replace(shipped.material, modulus=modulus)))
    found = indent_device(soft, condensed("device3")[0], body_of(soft), Interface.SHEAR)
    assert found.state.cuts <= halved


def test_deformable_actuators_need_their_body_and_rigid_ones_have_none() -> None:
    """Else they would be pressed as rigid ones, and nobody would know."""
    (soft, body), (rigid, _) = condensed("device3"), condensed("device2")
    with pytest.raises(MeshError, match="device3: found no condensed body for deformable actuators"):
        contact_problem(scene("device3"), soft, None, Interface.SHEAR)
    with pytest.raises(MeshError, match="device2: found a condensed body for rigid actuators"):
        contact_problem(scene("device2"), rigid, body, Interface.SHEAR)
