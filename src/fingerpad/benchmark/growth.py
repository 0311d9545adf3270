"""How cost grows with unknowns, contact nodes, actuators and increments."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..contact.linear_solution import indent_device, stimulate
from ..prediction.edges import edge_intervals
from ..prediction.scoring import condense_scene
from ..scene.contact_law import Criterion, Interface
from ..scene.device import ActuatorRow, Condition, evenly
from ..scene.scene import Scene
from ..tissue.mesh import mesh_section
from .timing import exponent, fewest

Row = dict[str, Any]
FINE = 0.5  # element sizes of the row of many actuators, of the scene's [1]; source: 14 contact nodes a pin (measured)
PITCH, WIDTH, EDGE_RADIUS = 0.06, 0.04, 0.01  # mm of the row of many; source: 64 of them still fit under the finger
STROKE = 0.002  # mm, upwards; source: a tenth of the devices', as the row is


def growth(scene: Scene, factors: Sequence[float], counts: Sequence[int], repeats: int) -> Iterator[Row]:
    """Seconds of set-up and of a condition with shear, for meshes coarser by `factors` with the same increments, for
    `factors` times larger increments on the same mesh, and for rows of as many actuators as `counts`.
    Raises MeshError, CondensationError, ContactError.
    """
    for factor in factors:
        yield _measured("mesh", _with_increments_of(scene, scene.coarsened(factor)), repeats)
    for factor in factors:
        numerics = scene.model.numerics.with_increments(1.0 / factor)
        yield _measured("increments", scene.with_model(numerics=numerics), repeats)
    for count in counts:
        yield _measured("actuators", row_of(scene, count), repeats)


def exponents(rows: Sequence[Row]) -> list[Row]:
    """Fitted exponents p of seconds = c size^p: of set-up against unknowns, and of a condition against the rest."""
    asked = (
        ("mesh", "unknowns", "setup_s"),
        ("mesh", "contact_nodes", "condition_s"),
        ("increments", "increments", "condition_s"),
        ("actuators", "actuators", "setup_s"),
        ("actuators", "actuators", "condition_s"),
    )
    found = []
    for varied, size, seconds in asked:
        own = [row for row in rows if row["varied"] == varied]
        sizes, times = [float(row[size]) for row in own], [float(row[seconds]) for row in own]
        found.append(
            {
                "seconds": seconds.removesuffix("_s"),
                "against": size,
                "from": min(sizes),
                "to": max(sizes),
                "exponent": round(exponent(sizes, times), 2),
            }
        )
    return found


def row_of(scene: Scene, count: int) -> Scene:
    """The scene with a row of `count` narrow actuators that must all touch; every other one moves up."""
    row = ActuatorRow(evenly(count, PITCH), WIDTH, EDGE_RADIUS)
    stroke = np.where(np.arange(count)[None, :] % 2 == 0, 0.0, STROKE)
    condition = Condition(
        name="up",
        dispersion="alternate",
        phase_deg=0.0,
        time=np.array([1.0]),
        normal=stroke,
        tangential=np.zeros_like(stroke),
    )
    model = replace(scene.model, contact=replace(scene.model.contact, criterion=Criterion.TOUCH))
    device = replace(
        scene.device, name=f"row_of_{count}", actuators=row, conditions=(condition,), cycles=(), frequencies=()
    )
    fine = replace(model, numerics=scene.coarsened(FINE).model.numerics)
    return _with_increments_of(scene, Scene(fine, device))


def _with_increments_of(scene: Scene, other: Scene) -> Scene:
    """The other scene, in as many increments as the first."""
    counts = scene.model.numerics
    numerics = replace(
        other.model.numerics,
        indentation_increments=counts.indentation_increments,
        stimulus_increments=counts.stimulus_increments,
    )
    return other.with_model(numerics=numerics)


def _measured(varied: str, scene: Scene, repeats: int) -> Row:
    """Seconds of one scene."""
    edges, finding = fewest(repeats, partial(edge_intervals, scene))
    condensed, condensing = fewest(repeats, partial(condense_scene, scene, edges))
    indenting = partial(indent_device, scene, condensed.section, condensed.body, Interface.SHEAR)
    indented, pressing = fewest(repeats, indenting)
    condition = scene.device.conditions[-1]
    _, moving = fewest(repeats, partial(stimulate, scene, indented, condition))
    section = mesh_section(scene, edges)
    numerics = scene.model.numerics
    return {
        "varied": varied,
        "unknowns": section.unknowns,
        "contact_nodes": condensed.section.position.shape[0],
        "actuators": len(scene.device.actuators.positions),
        "increments": numerics.indentation_increments + numerics.stimulus_increments,
        "setup_s": round(finding + condensing, 4),
        "condition_s": round(pressing + moving, 4),
    }
