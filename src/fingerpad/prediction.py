"""All scores of a scene in one process: mesh, condensation, contact, read-outs, scores."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from .compliance import CondensedBody, CondensedSection
from .condensation import body_of, condense_section
from .edges import edge_intervals
from .gabor import filtered_readouts
from .mesh import mesh_section
from .resampling import resampling_to_grid
from .roughness import score_rows
from .scene import Condition, FloatArray, Interface, Scene
from .solution import Solution, indent_device, stimulate
from .strain import FilteredReadouts, Resampling


@dataclass(frozen=True)
class Condensed:
    """All that conditions of a scene share."""

    section: CondensedSection
    body: CondensedBody | None
    resampling: Resampling


@dataclass(frozen=True)
class Solved:
    """The solution that holds for a condition at an interface."""

    condition: Condition
    interface: Interface
    solution: Solution


def condense_scene(scene: Scene, edges: FloatArray) -> Condensed:
    """Mesh, fine at the edges' intervals (k, 2) [mm], and condense. Raises MeshError, CondensationError."""
    section = condense_section(mesh_section(scene, edges), scene)
    body = body_of(scene)
    return Condensed(section, body, resampling_to_grid(section.arc, scene.model.gabor.spacing))


def rows_at(scene: Scene, coarsening: float) -> list[dict[str, Any]]:
    """Rows of the score table on sizes and increments `coarsening` times the scene's [1]; edges as for the scene."""
    other = scene.coarsened(coarsening)
    return predicted_rows(other, condense_scene(other, edge_intervals(scene)))


def predicted_rows(scene: Scene, condensed: Condensed) -> list[dict[str, Any]]:
    """Rows of the score table for all conditions and interfaces. Raises ContactError."""
    return [row for solved in solve_scene(scene, condensed) for row in rows_of(scene, condensed, solved)]


def solve_scene(scene: Scene, condensed: Condensed) -> Iterator[Solved]:
    """Solutions of all conditions and interfaces, one after the other; equal stimuli share one. Raises ContactError."""
    for interface in scene.device.interfaces():
        found: dict[str, Solution] = {}
        indented = None
        for condition in scene.device.conditions:
            solved_as = scene.solved_as(condition.name).name
            if solved_as not in found:
                if indented is None or not scene.model.skips.shared_indentation:
                    indented = indent_device(scene, condensed.section, condensed.body, interface)
                found[solved_as] = stimulate(scene, condensed.section, indented, condition)
            yield Solved(condition, interface, found[solved_as])


def rows_of(scene: Scene, condensed: Condensed, solved: Solved) -> list[dict[str, Any]]:
    """Rows of the score table for one solution."""
    return score_rows(scene, solved.condition, solved.interface, read_out(scene, condensed, solved.solution))


def read_out(scene: Scene, condensed: Condensed, solution: Solution) -> FilteredReadouts:
    """Filtered read-outs of a solution."""
    strains = solution.strain, solution.change_of_strain
    return filtered_readouts(condensed.resampling, *strains, scene.model.gabor)
