"""All scores of a scene in one process: mesh, condensation, contact, read-outs, scores."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

from ..arrays import FloatArray
from ..contact.linear_solution import indent_device, stimulate
from ..contact.solution import Solution
from ..errors import UnsolvedError
from ..finite.deformed_solution import press_finger, stimulate_deformed
from ..readouts.accuracy import COARSENING, score_errors
from ..readouts.gabor import FilteredReadouts, filtered_readouts
from ..readouts.resampling import resampling_to_grid, section_resampling
from ..readouts.roughness import NO_PREDICTION, score_rows, unscored_rows
from ..readouts.strain import Resampling
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.actuator_body import body_of
from ..tissue.compliance import CondensedBody, CondensedSection
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh, mesh_section
from .caveats import note_of, score_caveats

Result = TypeVar("Result")
Case = tuple[str, Interface]  # condition, interface
UNKNOWN = f"error unknown: on a mesh of {COARSENING:g} times the sizes, "  # and the reason


@dataclass(frozen=True)
class Condensed:
    """All that conditions of a scene with small kinematics share."""

    section: CondensedSection
    body: CondensedBody | None
    resampling: Resampling


@dataclass(frozen=True)
class Meshed:
    """All that conditions of a scene with finite kinematics share: what is condensed depends on the interface."""

    section: SectionMesh
    body: CondensedBody | None
    resampling: Resampling


@dataclass(frozen=True)
class ReadSolution:
    """A solution, what was read of it and, where that is asked for, what to know before believing it."""

    solution: Solution
    filtered: FilteredReadouts
    caveats: tuple[str, ...] = ()


@dataclass(frozen=True)
class Solved:
    """The solution that holds for a condition at an interface, or why there is none."""

    condition: Condition
    interface: Interface
    solution: Solution | UnsolvedError

    @property
    def case(self) -> Case:
        """Name of the condition, and interface."""
        return self.condition.name, self.interface


def prepared(scene: Scene, edges: FloatArray) -> Condensed | Meshed:
    """Mesh, fine at the edges' intervals (k, 2) [mm], and condense as the kinematics ask.

    Raises MeshError, CondensationError.
    """
    return mesh_scene(scene, edges) if scene.kinematics is Kinematics.FINITE else condense_scene(scene, edges)


def condense_scene(scene: Scene, edges: FloatArray) -> Condensed:
    """Mesh and condense the undeformed finger. Raises MeshError, CondensationError."""
    return condense_mesh(scene, mesh_section(scene, edges))


def condense_mesh(scene: Scene, mesh: SectionMesh) -> Condensed:
    """Condense the undeformed finger on a mesh. Raises MeshError, CondensationError."""
    return condensed_of(scene, condense_section(mesh, scene))


def condensed_of(scene: Scene, section: CondensedSection) -> Condensed:
    """All that conditions share, of a finger that is condensed already. Raises MeshError, CondensationError."""
    return Condensed(section, body_of(scene), resampling_to_grid(section.arc, scene.model.gabor.spacing))


def mesh_scene(scene: Scene, edges: FloatArray) -> Meshed:
    """Mesh alone, as the finger is condensed when it is pressed. Raises MeshError, CondensationError."""
    section = mesh_section(scene, edges)
    return Meshed(section, body_of(scene), section_resampling(section, scene))


def rows_at(scene: Scene, coarsening: float, edges: FloatArray) -> list[dict[str, Any]]:
    """Rows of the score table on sizes and increments `coarsening` times the scene's [1], with edges (k, 2) [mm].

    Raises what `prepared` and `predicted_rows` raise.
    """
    other = scene.coarsened(coarsening)
    return predicted_rows(other, prepared(other, edges))


def error_rows(
    scene: Scene, edges: FloatArray, read: Mapping[Case, ReadSolution], step: Callable[[], object] = lambda: None
) -> list[dict[str, Any]]:
    """Rows with the `score_error` of every score, from a solution with sizes and increments COARSENING times as large
    and edges (k, 2) [mm], which is read at the same time; None where that cannot be had, and a `note` that says why.

    read: what was read in the cases that have scores. step: called after condensation and after every condition.
    """
    other, rows = scene.coarsened(COARSENING), list[dict[str, Any]]()
    try:
        condensed = prepared(other, edges)
    except UnsolvedError as error:
        return [row for case in read for row in _errors_of(scene, case, f"{UNKNOWN}{error}")]
    step()
    for interface in scene.device.interfaces():
        asked = tuple(
            each.until(read[each.name, interface].solution.reading.time)
            for each in other.device.conditions
            if (each.name, interface) in read
        )
        if not asked:
            continue
        shown = other.with_conditions(asked)
        for solved in solve_scene(shown, condensed, [interface]):
            if isinstance(solved.solution, UnsolvedError):
                rows += _errors_of(scene, solved.case, f"{UNKNOWN}{solved.solution}")
            else:
                coarser = read_out(other, condensed, solved.solution)
                errors = score_errors(scene, read[solved.case].filtered, coarser)
                rows += _errors_of(scene, solved.case, "", errors)
            step()
    return rows


def _errors_of(
    scene: Scene, case: Case, note: str, errors: Mapping[Readout, float] | None = None
) -> list[dict[str, Any]]:
    """Rows with the errors of one case, or without."""
    condition, interface = case
    where = {"kinematics": str(scene.kinematics), "device": scene.device.name, "condition": condition}
    return [
        where
        | {"interface": str(interface), "readout": str(each), "score_error": (errors or {}).get(each)}
        | {"note": note}
        for each in Readout
    ]


def predicted_rows(scene: Scene, condensed: Condensed | Meshed) -> list[dict[str, Any]]:
    """Rows of the score table for all conditions at all interfaces.

    Raises UnsolvedError.
    """
    rows: list[dict[str, Any]] = []
    for solved in solve_scene(scene, condensed):
        if isinstance(solved.solution, UnsolvedError):
            raise solved.solution
        read = read_solution(scene, condensed, solved.condition, solved.interface, solved.solution)
        rows += score_rows(scene, solved.condition, solved.interface, read.filtered, note_of(read.caveats))
    return rows


def solved_rows(
    scene: Scene, edges: FloatArray, step: Callable[[], object] = lambda: None
) -> tuple[list[dict[str, Any]], dict[Case, ReadSolution]]:
    """Rows of the score table of what the device moves, on a mesh with edges (k, 2) [mm], and what was read in the
    cases that have scores. What cannot be meshed or solved has no score, and a note that says why.

    step: called after condensation and after every condition.
    """
    condensed = attempt(prepared, scene, edges)
    step()
    rows: list[dict[str, Any]] = []
    read: dict[Case, ReadSolution] = {}
    for solved in solve_scene(scene, condensed):
        if isinstance(solved.solution, UnsolvedError) or isinstance(condensed, UnsolvedError):
            note = f"{NO_PREDICTION}: {solved.solution}"
            rows += unscored_rows(scene, solved.condition, solved.interface, note)
        else:
            own = read_solution(scene, condensed, solved.condition, solved.interface, solved.solution)
            read[solved.case] = own
            rows += score_rows(scene, solved.condition, solved.interface, own.filtered, note_of(own.caveats))
        step()
    return rows, read


def solve_scene(
    scene: Scene, condensed: Condensed | Meshed | UnsolvedError, interfaces: Sequence[Interface] = ()
) -> Iterator[Solved]:
    """All conditions at some interfaces, or all, solved in turn as far as they can be, which is not at all where the
    finger could not be meshed or condensed; equal stimuli share one.
    """
    for interface in interfaces or scene.device.interfaces():
        found: dict[str, Solution | UnsolvedError] = {}
        pressed: Callable[[Condition], Solution] | UnsolvedError | None = None
        for condition in scene.device.conditions:
            solved_as = scene.solved_as(condition.name).name
            if solved_as not in found:
                if isinstance(condensed, UnsolvedError):
                    pressed = condensed
                elif pressed is None or not scene.model.skips.shared_indentation:
                    pressed = attempt(pressed_device, scene, condensed, interface)
                found[solved_as] = pressed if isinstance(pressed, UnsolvedError) else attempt(pressed, condition)
            yield Solved(condition, interface, found[solved_as])


def attempt(solve: Callable[..., Result], *given: object) -> Result | UnsolvedError:
    """What is found, or why it cannot be."""
    try:
        return solve(*given)
    except UnsolvedError as error:
        return error


def pressed_device(
    scene: Scene, condensed: Condensed | Meshed, interface: Interface
) -> Callable[[Condition], Solution]:
    """Press the device onto the finger: what solves the stimulus of a condition from there. Raises MeshError,
    CondensationError, ContactError.
    """
    if isinstance(condensed, Meshed):
        finger = press_finger(scene, condensed.section, condensed.body, interface)
        return partial(stimulate_deformed, scene, finger)
    return partial(stimulate, scene, indent_device(scene, condensed.section, condensed.body, interface))


def read_solution(
    scene: Scene, condensed: Condensed | Meshed, condition: Condition, interface: Interface, solution: Solution
) -> ReadSolution:
    """A solution of a condition at an interface, read."""
    caveats = score_caveats(scene, condition, interface, solution, condensed.resampling)
    return ReadSolution(solution, read_out(scene, condensed, solution), tuple(caveats))


def read_out(scene: Scene, condensed: Condensed | Meshed, solution: Solution) -> FilteredReadouts:
    """Filtered read-outs of a solution."""
    return filtered_readouts(condensed.resampling, solution.reading.readouts, scene.model.gabor)
