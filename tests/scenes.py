"""The shipped scenes, condensed once for all tests of a session."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

from fingerpad.calculix.deck import DeckSettings
from fingerpad.contact.linear_solution import solve_condition
from fingerpad.contact.solution import Solution
from fingerpad.prediction.edges import mesh_device
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import Condition
from fingerpad.scene.scene import Scene
from fingerpad.scene.scenefile import load_scene
from fingerpad.tissue.actuator_body import body_of
from fingerpad.tissue.compliance import CondensedBody, CondensedSection
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.mesh import SectionMesh

CONFIG = Path(__file__).parents[1] / "config"
DECK = DeckSettings(
    height=1.25,
    friction_indenting=0.0,
    friction_acting=0.6,
    pressure_slope=500.0,
    stick_slope=100.0,
    indentation_increments=10,
    stimulus_increments=4,
    rest_increments=2,
)


@cache
def scene(device: str) -> Scene:
    """A shipped scene."""
    return load_scene(CONFIG / "config.yaml", CONFIG / "devices" / f"{device}.yaml")


@cache
def section(device: str) -> SectionMesh:
    """Its mesh."""
    return mesh_device(scene(device))


@cache
def condensed(device: str) -> tuple[CondensedSection, CondensedBody | None]:
    """Its condensed tissue and actuators."""
    body = body_of(scene(device))
    return condense_section(section(device), scene(device)), body


@cache
def solved(device: str, condition: str, interface: Interface) -> Solution:
    """A solved condition."""
    return solve(device, scene(device).device.condition(condition), interface)


def solve(device: str, condition: Condition, interface: Interface, **numerics: int) -> Solution:
    """Any condition of a shipped device, with numerics changed on request."""
    base = scene(device)
    model = replace(base.model, numerics=replace(base.model.numerics, **numerics))
    return solve_condition(replace(base, model=model), *condensed(device), condition, interface)
