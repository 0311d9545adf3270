"""Run time against error: one condition, with shear, on a ladder of meshes, by fingerpad and by a plain solver."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from ..compliance import CondensedSection
from ..edges import edge_intervals
from ..errors import SceneError
from ..mesh import SectionMesh, mesh_section
from ..prediction import Condensed, condense_scene, read_out
from ..roughness import score_rows
from ..scene import Condition, Interface, Readout, Scene
from ..solution import Indented, increments, indent_device, stimulate
from .plain import plain_scores
from .timing import fewest, peak_memory

Row = dict[str, Any]
OWN_LADDER, PLAIN_LADDER = "fingerpad", "factorised anew"
PATH = 1.8  # ways from first touch to the outermost face [1] that pre-indentation takes; source: devices (measured)


def own_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], reference: Sequence[Mapping[str, Any]], repeats: int
) -> Iterator[Row]:
    """A row for each coarsening of mesh and increments: seconds from scene to score (cold), of a further condition
    (warm) and of a further stimulus on the pressed finger; errors of the scores against the reference's.
    """
    for factor in factors:
        other = scene.coarsened(factor)
        condensed, cold = fewest(repeats, partial(_condensed, other))
        indenting = partial(indent_device, other, condensed.section, condensed.body, Interface.SHEAR)
        indented, pressing = fewest(repeats, indenting)
        found, stimulating = fewest(repeats, partial(_scores, other, condensed, indented, condition))
        seconds = cold + pressing + stimulating, pressing + stimulating, stimulating
        section = mesh_section(other, edge_intervals(other))
        yield _row(OWN_LADDER, factor, section, condensed.section, seconds, _errors(found, reference))


def plain_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], reference: Sequence[Mapping[str, Any]]
) -> Iterator[Row]:
    """The same by a solver that factorises the whole section anew for every increment. How deep to press and where the
    mesh is fine it is told, at no cost. Raises SceneError if the actuators deform.
    """
    if scene.device.actuators.body is not None:
        raise SceneError(f"{scene.device.name}: the plain solver knows rigid actuators only")
    condensed = _condensed(scene)
    indented = indent_device(scene, condensed.section, None, Interface.SHEAR)
    depth, edges = float(indented.state.actuator[0, 1]), edge_intervals(scene)
    for factor in factors:
        other = scene.coarsened(factor)
        pressing, stimulating = increments(other, indented.problem)
        counts = round(PATH * pressing), stimulating
        section = mesh_section(other, edges)
        (last, found), cold = fewest(1, partial(plain_scores, other, section, condition, depth, counts))
        yield _row(PLAIN_LADDER, factor, section, last, (cold, cold, cold), _errors(found, reference))


def _condensed(scene: Scene) -> Condensed:
    return condense_scene(scene, edge_intervals(scene))


def _scores(scene: Scene, condensed: Condensed, indented: Indented, condition: Condition) -> list[Row]:
    solution = stimulate(scene, condensed.section, indented, condition)
    return score_rows(scene, condition, indented.interface, read_out(scene, condensed, solution))


def _errors(found: Sequence[Mapping[str, Any]], reference: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    """Error of each read-out's score against the reference's [1]."""
    case = ("condition", "interface", "readout")
    wanted = {tuple(row[key] for key in case): float(row["score"]) for row in reference if row["score"] != ""}
    errors = {row["readout"]: abs(row["score"] / wanted[tuple(row[key] for key in case)] - 1.0) for row in found}
    return {f"error_{readout}": errors[readout] for readout in Readout}


def _row(
    solver: str,
    factor: float,
    section: SectionMesh,
    condensed: CondensedSection,
    seconds: tuple[float, float, float],
    errors: Mapping[str, float],
) -> Row:
    cold, warm, stimulus = seconds
    return {
        "solver": solver,
        "coarsening": factor,
        "unknowns": 2 * int(section.mesh.doflocs.shape[1]),
        "contact_nodes": condensed.position.shape[0],
        "cold_s": round(cold, 4),
        "warm_s": round(warm, 4),
        "stimulus_s": round(stimulus, 4),
        **{name: f"{error:.2e}" for name, error in errors.items()},
        "peak_MiB_so_far": round(peak_memory()),
    }
