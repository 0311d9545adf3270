"""Designs of a row of rigid pins, each answered in a fraction of a second on a finger that is condensed once.

The finger is condensed to all skin within reach of any design, and is equally fine everywhere, as no edge has a place
of its own. A second condensation, whose elements are twice as large, gives every score its error as in the workflow
(`accuracy`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..contact.linear_solution import Indented, indent_device, stimulate
from ..contact.solution import Solution
from ..errors import ContactError, UnsolvedError
from ..readouts.accuracy import COARSENING, score_errors, with_error
from ..readouts.gabor import FilteredReadouts
from ..readouts.roughness import score_rows
from ..scene.contact_law import Interface
from ..scene.device import ActuatorRow, Condition, Control, Device, evenly
from ..scene.readout import Readout
from ..scene.scene import Model, Scene
from ..scene.stimuli import ALTERNATE, at_peak
from ..tissue.compliance import CondensedSection
from ..tissue.mesh import mesh_section
from .caveats import note_of, score_caveats
from .scoring import Condensed, attempt, condense_mesh, read_out

# times the configured size of elements at edges [1]; source: Device 2 scores as in the workflow within errors (a test)
SIZE = 4.0
# mm beside a pin in which its skin may lie; source: skin moves by 0.5 mm under far, slippery pins (measured)
ROOM = 0.6
NAME = "design"


@dataclass(frozen=True)
class Pad:
    """A finger condensed to all skin within reach.

    scene: gives the model, the number of pins and their edges. fine, coarse: the skin on both meshes.
    """

    scene: Scene
    fine: Condensed
    coarse: Condensed


@dataclass(frozen=True)
class PressedRow:
    """A row pressed onto a finger. scene: the row at rest. skin: that it is pressed onto."""

    scene: Scene
    skin: Condensed
    indented: Indented


@dataclass(frozen=True)
class Answer:
    """What a design feels like.

    scene: of the design, with one condition. section, solution, readouts: on the finer mesh. rows: of the score table,
    with errors, or without, which `unknown` then explains.
    """

    scene: Scene
    section: CondensedSection
    solution: Solution
    readouts: FilteredReadouts
    rows: list[dict[str, Any]]
    unknown: str = ""


def pins_at_rest(model: Model, count: int, pitch: float, width: float, edge_radius: float) -> Scene:
    """A row of rigid pins [mm], evenly spaced. Raises SceneError if they overlap or numbers are out of range."""
    row = ActuatorRow(evenly(count, pitch), width, edge_radius)
    return Scene(model, Device(NAME, NAME, Control.DISPLACEMENT, row, (_condition(count, 0.0, 0.0, True),)))


def condense_pad(scene: Scene, reach: float) -> Pad:
    """Condense a finger to the skin up to |x| = reach [mm], where the outermost pin of any design may end, and ROOM.

    Raises SceneError if the finger is narrower, MeshError, CondensationError.
    """
    skin = _as_meshed(scene)
    scenes = (skin, skin.coarsened(COARSENING))
    return Pad(scene, *(_condensed(each, reach + ROOM) for each in scenes))


def press_row(pad: Pad, pitch: float, width: float, friction: float) -> tuple[PressedRow, PressedRow | ContactError]:
    """Press a row of pins with that pitch and width [mm] and friction coefficient [1] onto both meshes; in place of the
    coarser one stands why its path cannot be followed, if it cannot.

    Raises SceneError if pins overlap or numbers are out of range, MeshError if a pin is nearest to no skin node,
    ContactError if the path cannot be followed on the finer mesh.
    """
    model, row = pad.scene.model, pad.scene.device.actuators
    model = replace(model, contact=replace(model.contact, friction=friction))
    scene = pins_at_rest(model, len(row.positions), pitch, width, row.edge_radius)
    fine = _pressed(scene, pad.fine)
    try:
        return fine, _pressed(scene.with_model(numerics=model.numerics.coarsened(COARSENING)), pad.coarse)
    except ContactError as error:
        return fine, error


def answer(
    pressed: tuple[PressedRow, PressedRow | ContactError], amplitude: float, phase_deg: float, lateral: bool
) -> Answer:
    """Move the pins of a pressed row, sideways or up and down, read and score: pins 1, 3, ... by the amplitude A [mm],
    pins 2, 4, ... by A cos(p) with p the phase [degrees] between neighbours.

    Raises SceneError if pins run into each other, ContactError if the path cannot be followed on the finer mesh.
    """
    fine, coarse = pressed
    count = len(fine.scene.device.actuators.positions)
    condition = _condition(count, amplitude, phase_deg, lateral)
    found = _moved(fine, condition)
    coarser = coarse if isinstance(coarse, ContactError) else attempt(_moved, coarse, condition)
    if isinstance(coarser, UnsolvedError):
        return replace(found, rows=[with_error(row, None) for row in found.rows], unknown=str(coarser))
    errors = score_errors(found.scene, found.readouts, coarser.readouts)
    return replace(found, rows=[with_error(row, errors[Readout(row["readout"])]) for row in found.rows])


def _condition(count: int, amplitude: float, phase_deg: float, lateral: bool) -> Condition:
    """The state at the first pin's peak."""
    moved = at_peak(amplitude, phase_deg * np.resize([0.0, 1.0], count))[None, :]
    normal, tangential = (np.zeros_like(moved), moved) if lateral else (moved, np.zeros_like(moved))
    return Condition(NAME, ALTERNATE, phase_deg, np.array([1.0]), normal, tangential)


def _moved(row: PressedRow, condition: Condition) -> Answer:
    """The answer on one mesh, its rows with caveats as notes and without errors. Raises ContactError."""
    scene = row.scene.with_conditions([condition])
    solution = stimulate(scene, row.indented, condition)
    readouts = read_out(scene, row.skin, solution)
    caveats = score_caveats(_as_meshed(scene), condition, Interface.SHEAR, solution, row.skin.resampling)
    rows = score_rows(scene, condition, Interface.SHEAR, readouts, note_of(caveats))
    return Answer(scene, row.skin.section, solution, readouts, rows)


def _as_meshed(scene: Scene) -> Scene:
    """The scene with the size of the pad's elements at the edges."""
    numerics = scene.model.numerics
    return scene.with_model(numerics=replace(numerics, edge_size=SIZE * numerics.edge_size))


def _condensed(scene: Scene, reach: float) -> Condensed:
    """All skin within reach [mm], as if it lay under one wide pin."""
    covered = pins_at_rest(scene.model, 1, 0.0, 2.0 * reach, 0.0)
    return condense_mesh(covered, mesh_section(covered, np.array([[0.0, reach]])))


def _pressed(scene: Scene, skin: Condensed) -> PressedRow:
    return PressedRow(scene, skin, indent_device(scene, skin.section, None, Interface.SHEAR))
