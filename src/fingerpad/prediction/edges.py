"""Where the actuators' edges will lie on the skin: the mesh is fine there, and only there.

Skin moves sideways while it is indented, under an outer actuator by a quarter of a millimetre, so the edges do not end
up where undeformed skin lies over them. A coarse solution of all conditions finds where they do.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import ContactProblem, ContactState
from ..contact.linear_solution import follow_condition, indented_state
from ..contact.problem import contact_problem
from ..errors import CondensationError, ContactError, CriterionError, MeshError
from ..finite.pressing import press
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..store import read_rows, write_rows
from ..tissue.actuator_body import body_of
from ..tissue.compliance import CondensedBody, CondensedSection
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh, merged, mesh_section, nominal_edges

COLUMNS = ("start_mm", "stop_mm")  # of a table of intervals
COARSER = 4.0  # times [1] the sizes and strides of the scene; source: intervals then agree to 0.003 mm with small
# kinematics, 0.006 mm with finite ones (measured against 1.5 and 2), where elements have grown by a fifteenth
REACH = 0.3  # mm by which edges may lie off their nominal place; source: largest shift in the shipped devices


def mesh_device(scene: Scene) -> SectionMesh:
    """Mesh of the finger's section for a device, fine where the actuators' edges will lie. Raises MeshError."""
    return mesh_section(scene, edge_intervals(scene))


def save_edges(path: Path, intervals: FloatArray) -> None:
    """Write intervals (k, 2) [mm] as a CSV table."""
    write_rows(path, [dict(zip(COLUMNS, map(float, interval), strict=True)) for interval in intervals])


def load_edges(path: Path) -> FloatArray:
    """Intervals (k, 2) [mm] that `save_edges` wrote."""
    return np.array([[float(row[column]) for column in COLUMNS] for row in read_rows(path, *COLUMNS)])


def edge_intervals(scene: Scene) -> FloatArray:
    """Intervals (k, 2) of x [mm] on the undeformed skin over which rounded edges lie in any condition.

    If there is no coarse mesh, or a path is lost on it, the nominal intervals and REACH around them. An interface whose
    criterion of pre-indentation is out of reach, on a finer coarse mesh as well, has no say; if all are such, the
    nominal intervals alone.
    """
    nominal = nominal_edges(scene.device.actuators)
    wide = nominal + REACH * np.array([-1.0, 1.0])
    found = list[FloatArray]()
    for times in (COARSER, COARSER / 2.0):
        try:
            ends = list(_found_edges(scene.coarsened(times), wide))
        except (MeshError, CondensationError):
            return wide
        failures = [each for each in ends if isinstance(each, ContactError)]
        found = [each for each in ends if not isinstance(each, ContactError)]
        if not all(isinstance(failure, CriterionError) for failure in failures):
            return wide
        if not failures:
            break
    if not found:
        return nominal
    start, stop = np.min([each[:, 0] for each in found], axis=0), np.max([each[:, 1] for each in found], axis=0)
    return merged(np.stack([start, stop], axis=1))


def _found_edges(scene: Scene, edges: FloatArray) -> Iterator[FloatArray | ContactError]:
    """`_under_edges` of all states of a scene's conditions, as far as they can be followed, and why not further. Raises
    MeshError, CondensationError.
    """
    section, body = mesh_section(scene, edges), body_of(scene)
    condensed = condense_section(section, scene) if scene.kinematics is Kinematics.SMALL else None
    for interface in scene.device.interfaces():
        try:
            problem, before = _pressed_state(scene, section, condensed, body, interface)
        except ContactError as failure:
            yield failure
            continue
        yield _under_edges(problem, before)
        for condition in scene.device.distinct_conditions:
            try:
                for state in follow_condition(scene, problem, before, condition):
                    yield _under_edges(problem, state)
            except ContactError as failure:
                yield failure


def _pressed_state(
    scene: Scene,
    section: SectionMesh,
    condensed: CondensedSection | None,
    body: CondensedBody | None,
    interface: Interface,
) -> tuple[ContactProblem, ContactState]:
    """The pre-indented state, and the problem for stimuli from there: without a condensed section, with finite
    kinematics, on tissue linearised about that state, as they move it little. Raises ContactError.
    """
    if condensed is not None:
        problem = contact_problem(scene, condensed, body, interface)
        return problem, indented_state(scene, problem)
    pressed = press(scene, section, body, interface)
    problem = contact_problem(scene, pressed.section, body, interface)
    return replace(problem, free=pressed.free), pressed.state


def _under_edges(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Intervals (2 n_actuators, 2) of undeformed x [mm] of the skin that lies over the rounded edges."""
    row, centre = problem.row, problem.row.positions + state.actuator[:, 0]
    now, before = state.place + centre[state.given], problem.position[:, 0]
    return np.interp(np.add.outer(centre, row.edges), now, before).reshape(-1, 2)
