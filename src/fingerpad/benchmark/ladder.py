"""Run time against error: one condition, with shear, on ladders of ever finer meshes, by fingerpad and by others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from ..contact.linear_solution import indent_device
from ..contact.problem import indentation_increments, stimulus_increments
from ..contact.solution import Solution
from ..errors import SceneError
from ..prediction.edges import edge_intervals, mesh_device
from ..prediction.scoring import Condensed, Meshed, condense_scene, prepared, pressed_device, read_out, rows_at
from ..readouts.accuracy import relative_changes, scores_by_case
from ..readouts.roughness import score_rows
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.mesh import SectionMesh, mesh_section
from ..tissue.reach import contact_tractions
from .first_order import condense_first_order
from .ladders import FIRST_ORDER_LADDER, OWN_LADDER, PLAIN_LADDER
from .plain import plain_scores
from .timing import fewest, peak_memory

Row = dict[str, Any]
# pre-indentation's whole path over the way from first touch to the outermost face, which the number of increments
# divides [1]; source: devices (measured)
PATH = 1.8


def reference_rows(scene: Scene, condition: Condition, coarsening: float) -> list[Row]:
    """Score rows of one condition on sizes and increments `coarsening` times the scene's [1], which errors are measured
    against; the mesh is fine where all conditions put the edges. Raises as `own_ladder`.
    """
    alone = scene.with_conditions([condition])
    return rows_at(alone, coarsening, edge_intervals(scene))


def own_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], reference: Sequence[Mapping[str, Any]], repeats: int
) -> Iterator[Row]:
    """A row for each coarsening of mesh and increments: seconds from scene to score (cold), of a further condition
    (warm) and of a further stimulus on the pressed finger; errors of the scores against the reference's.
    Raises MeshError, CondensationError, ContactError.
    """
    for factor in factors:
        found, seconds, section, nodes = _climbed(scene.coarsened(factor), condition, _prepared, repeats)
        yield _row(scene.kinematics, OWN_LADDER, factor, section.unknowns, nodes, seconds, _errors(found, reference))


def first_order_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], reference: Sequence[Mapping[str, Any]], repeats: int
) -> Iterator[Row]:
    """`own_ladder` with first-order elements (`condense_first_order`), for small kinematics. Raises as `own_ladder`."""
    for factor in factors:
        found, seconds, section, nodes = _climbed(scene.coarsened(factor), condition, _prepared_first_order, repeats)
        unknowns = 2 * int(section.mesh.nvertices)
        yield _row(scene.kinematics, FIRST_ORDER_LADDER, factor, unknowns, nodes, seconds, _errors(found, reference))


def plain_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], reference: Sequence[Mapping[str, Any]]
) -> Iterator[Row]:
    """`own_ladder` by a solver that factorises the whole section anew for every increment (`plain_scores`), so that a
    further condition or stimulus costs it as much as the first. To which height to press, and where the mesh must be
    fine, it is told; the seconds to find them are not counted. Raises SceneError if the actuators deform, and as
    `own_ladder`.
    """
    if scene.device.actuators.body is not None:
        raise SceneError(f"{scene.device.name}: the plain solver knows rigid actuators only")
    edges = edge_intervals(scene)
    condensed = condense_scene(scene, edges)
    indented = indent_device(scene, condensed.section, None, Interface.SHEAR)
    height = float(indented.state.actuator[0, 1])
    for factor in factors:
        other = scene.coarsened(factor)
        problem = indented.problem
        counts = round(PATH * indentation_increments(other, problem)), stimulus_increments(other, problem)
        section = mesh_section(other, edges)
        found, cold = fewest(1, partial(plain_scores, other, section, condition, height, counts))
        seconds, nodes = (cold, cold, cold), contact_tractions(section, other).weight.size
        yield _row(scene.kinematics, PLAIN_LADDER, factor, section.unknowns, nodes, seconds, _errors(found, reference))


def _climbed(
    scene: Scene, condition: Condition, prepare: Callable[[Scene], Condensed | Meshed], repeats: int
) -> tuple[list[Row], tuple[float, float, float], SectionMesh, int]:
    """On one mesh of a ladder: score rows, seconds as of `own_ladder` (cold, warm, stimulus), mesh, contact nodes."""
    condensed, cold = fewest(repeats, partial(prepare, scene))
    solve, pressing = fewest(repeats, partial(pressed_device, scene, condensed, Interface.SHEAR))
    found, stimulating = fewest(repeats, partial(_scores, scene, condensed, solve, condition))
    section = mesh_device(scene)
    seconds = cold + pressing + stimulating, pressing + stimulating, stimulating
    return found, seconds, section, contact_tractions(section, scene).weight.size


def _prepared(scene: Scene) -> Condensed | Meshed:
    return prepared(scene, edge_intervals(scene))


def _prepared_first_order(scene: Scene) -> Condensed:
    return condense_first_order(scene, mesh_device(scene))


def _scores(
    scene: Scene, condensed: Condensed | Meshed, solve: Callable[[Condition], Solution], condition: Condition
) -> list[Row]:
    return score_rows(scene, condition, Interface.SHEAR, read_out(scene, condensed, solve(condition)))


def _errors(found: Sequence[Mapping[str, Any]], reference: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    """Columns with the error of each read-out's score against the reference's [1], of one condition."""
    changes = relative_changes(scores_by_case(found), scores_by_case(reference))
    return {f"error_{readout}": change for (*_, readout), change in changes.items()}


def _row(
    kinematics: Kinematics,
    solver: str,
    factor: float,
    unknowns: int,
    contact_nodes: int,
    seconds: tuple[float, float, float],
    errors: Mapping[str, float],
) -> Row:
    cold, warm, stimulus = seconds
    return {
        "kinematics": str(kinematics),
        "solver": solver,
        "coarsening": factor,
        "unknowns": unknowns,
        "contact_nodes": contact_nodes,
        "cold_s": round(cold, 4),
        "warm_s": round(warm, 4),
        "stimulus_s": round(stimulus, 4),
        **{name: f"{error:.2e}" for name, error in errors.items()},
        "peak_MiB_so_far": round(peak_memory()),
    }
