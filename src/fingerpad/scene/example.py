"""The device and the condition that stand for all where one is shown: figures 3 and 6, the report, notebooks."""

from __future__ import annotations

from collections.abc import Sequence

from .contact_law import Interface
from .device import Condition, Device

COMPARED = ("device2", "alternate_180")  # what comparisons with CalculiX and of run times are about, too


def compares_interfaces(device: Device) -> bool:
    """Whether it moves sideways, and is predicted without friction as well."""
    sideways = any(condition.tangential.any() for condition in device.conditions)
    return sideways and Interface.FRICTIONLESS in device.interfaces()


def example_device(devices: Sequence[Device]) -> Device:
    """Device 2, as in the paper's figures 3 and 6; without it the first that both can show, or else the first."""
    return min(devices, key=lambda device: (not compares_interfaces(device), device.name != COMPARED[0]))


def example_condition(devices: Sequence[Device]) -> tuple[Device, Condition]:
    """Device 2's pins 180 degrees apart; without these the last condition of the example device."""
    for device in devices:
        for condition in device.conditions:
            if (device.name, condition.name) == COMPARED:
                return device, condition
    device = example_device(devices)
    return device, device.conditions[-1]
