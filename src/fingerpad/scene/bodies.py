"""Kinds of bodies that a device file may give its actuators.

A kind is a class in BODIES and a definition of the same name in `workflow/schemas/device.schema.yaml`, whose keys are
modulus, poisson and the class's fields. Nothing else knows the kinds (docs/extending.md shows how to add one).
"""

from __future__ import annotations

from collections.abc import Mapping

from .device import Body

BODIES: Mapping[str, type[Body] | None] = {
    "rigid": None,
    "deformable": Body,
}
