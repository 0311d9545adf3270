"""Sliders: a change draws anew, and a design without an answer is said to have none."""

from __future__ import annotations

import pytest

from fingerpad.design import condense_pad
from fingerpad.errors import ContactError
from fingerpad.explorer import LIMITS, START, Explorer, reach
from scenes import scene

PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def explorer() -> Explorer:
    """Sliders on Device 2's finger."""
    return Explorer(condense_pad(scene("device2"), reach(scene("device2"))))


def test_it_starts_with_device_2(explorer: Explorer) -> None:
    row = scene("device2").device.actuators
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
    explorer.sliders[name].value = (START[name] + LIMITS[name][0]) / 2.0
    assert bytes(explorer.picture.value).startswith(PNG)
    assert bytes(explorer.picture.value) != before
    assert not explorer.message.value


def test_direction_draws_anew(explorer: Explorer) -> None:
    before = bytes(explorer.picture.value)
    explorer.direction.value = "normal"
    assert bytes(explorer.picture.value) != before


def test_design_without_an_answer_is_a_message(explorer: Explorer, monkeypatch: pytest.MonkeyPatch) -> None:
    """The picture stays, the reason is told, and text from an error is no markup."""
    before = bytes(explorer.picture.value)

    def refuse(*_: object) -> None:
        raise ContactError("contact at x < 1 mm")

    monkeypatch.setattr("fingerpad.explorer.answer", refuse)
    explorer.sliders["phase"].value = 30.0
    assert bytes(explorer.picture.value) == before
    assert "contact at x &lt; 1 mm" in explorer.message.value
