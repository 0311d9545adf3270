"""Which device and condition stand for all."""

from __future__ import annotations

from dataclasses import replace

import pytest

from fingerpad.scene.device import Device
from fingerpad.scene.example import compares_interfaces, example_condition, example_device
from scenes import scene

ONE, TWO, THREE = (scene(f"device{number}").device for number in (1, 2, 3))
OTHER = replace(TWO, name="other")


def test_what_moves_sideways_with_and_without_friction_compares_both() -> None:
    assert compares_interfaces(TWO)
    assert not compares_interfaces(ONE)  # moves up and down
    assert not compares_interfaces(THREE)  # is not predicted without
    assert not compares_interfaces(replace(TWO, frictionless=False))


@pytest.mark.parametrize(
    ("devices", "expected"),
    [
        ([ONE, TWO, THREE], "device2"),
        ([OTHER, TWO], "device2"),
        ([ONE, OTHER], "other"),
        ([ONE, THREE], "device1"),
        ([ONE, replace(TWO, frictionless=False)], "device2"),
        ([replace(TWO, frictionless=False), OTHER], "other"),
    ],
)
def test_example_is_device_2_or_what_can_be_compared_or_the_first(devices: list[Device], expected: str) -> None:
    assert example_device(devices).name == expected


@pytest.mark.parametrize(
    ("devices", "expected"),
    [
        ([ONE, TWO, THREE], ("device2", "alternate_180")),
        ([replace(TWO, conditions=TWO.conditions[::-1])], ("device2", "alternate_180")),
        ([replace(TWO, conditions=TWO.conditions[:2])], ("device2", "alternate_090")),
        ([ONE, THREE], ("device1", ONE.conditions[-1].name)),
    ],
)
def test_condition_is_pins_half_a_cycle_apart_or_the_last(devices: list[Device], expected: tuple[str, str]) -> None:
    device, condition = example_condition(devices)
    assert (device.name, condition.name) == expected
