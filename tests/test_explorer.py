"""Sliders: a change draws anew, and a design without an answer is said to have none."""

from __future__ import annotations

from typing import Any

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from fingerpad.errors import ContactError
from fingerpad.explorer import EDGE_RADIUS, LIMITS, PINS, START, Explorer, explored_pad
from fingerpad.figures.design import DesignPicture
from fingerpad.prediction.design import Answer, answer
from scenes import scene

PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def shared() -> Explorer:
    """Sliders on the shipped finger."""
    return Explorer(explored_pad(scene("device2").model))


@pytest.fixture
def explorer(shared: Explorer) -> Explorer:
    """The same where they start."""
    shared.direction.value = "lateral"
    for name, slider in shared.sliders.items():
        slider.value = START[name]
    return shared


def test_it_starts_with_device_2(explorer: Explorer) -> None:
    row = scene("device2").device.actuators
    assert len(row.positions) == PINS
    assert row.edge_radius == EDGE_RADIUS
    assert START["pitch"] == pytest.approx(row.positions[1] - row.positions[0])
    assert START["width"] == row.width
    assert START["friction"] == scene("device2").model.contact.friction
    assert bytes(explorer.picture.value).startswith(PNG)
    assert explorer.seconds > 0.0


def test_sliders_hold_where_they_start(explorer: Explorer) -> None:
    assert {name: slider.value for name, slider in explorer.sliders.items()} == START
    assert all(low <= START[name] <= high for name, (low, high, _) in LIMITS.items())


@pytest.mark.parametrize("name", list(LIMITS))
def test_each_slider_draws_anew(explorer: Explorer, name: str) -> None:
    before = bytes(explorer.picture.value)
    explorer.sliders[name].value = (2.0 * START[name] + LIMITS[name][0]) / 3.0
    assert bytes(explorer.picture.value).startswith(PNG)
    assert bytes(explorer.picture.value) != before
    assert not explorer.message.value


def test_direction_draws_anew(explorer: Explorer) -> None:
    before = bytes(explorer.picture.value)
    explorer.direction.value = "normal"
    assert bytes(explorer.picture.value) != before


def test_contact_is_solved_on_one_thread(explorer: Explorer, monkeypatch: pytest.MonkeyPatch) -> None:
    """A notebook's kernel has as many as the machine has cores, with which small systems take several times as long."""
    seen = []

    def answer_on(*given: Any) -> Answer:
        seen.extend(library["num_threads"] for library in threadpool_info())
        return answer(*given)

    monkeypatch.setattr("fingerpad.explorer.answer", answer_on)
    with threadpool_limits(2):
        explorer.sliders["phase"].value = 60.0
    assert set(seen) == {1}


def test_design_without_an_answer_is_a_message(explorer: Explorer, monkeypatch: pytest.MonkeyPatch) -> None:
    """The picture stays, the reason is told, and text from an error is no markup."""
    before = bytes(explorer.picture.value)

    def refuse(*_: object) -> None:
        raise ContactError("contact at x < 1 mm")

    monkeypatch.setattr("fingerpad.explorer.answer", refuse)
    explorer.sliders["phase"].value = 30.0
    assert bytes(explorer.picture.value) == before
    assert "contact at x &lt; 1 mm" in explorer.message.value


@pytest.mark.parametrize("direction", ["lateral", "normal"])
def test_what_is_drawn_moves_as_the_controls_say_beside_what_was_drawn(
    explorer: Explorer, monkeypatch: pytest.MonkeyPatch, direction: str
) -> None:
    moves, drawn = [], []

    def answer_of(pressed: Any, *given: Any) -> Answer:
        moves.append(given)
        return answer(pressed, *given)

    monkeypatch.setattr("fingerpad.explorer.answer", answer_of)
    monkeypatch.setattr(DesignPicture, "show", lambda _, *given: drawn.append(given))
    explorer.direction.value = direction
    explorer.redraw()
    explorer.redraw()
    assert moves[-1] == (explorer.sliders["amplitude"].value, explorer.sliders["phase"].value, direction == "lateral")
    assert drawn[-1][1] is drawn[-2][0]
