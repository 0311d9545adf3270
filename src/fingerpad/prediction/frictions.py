"""Scores against the coefficient of friction, from none on: "without shear" is friction of exactly zero."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ..errors import UnsolvedError
from ..readouts.roughness import score_rows
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from .edges import edge_intervals
from .scoring import prepared, read_out, solve_scene

# Coefficients of friction [1]; source: none at all, lubricated and dry skin, and steps between them, closest where pins
# that move by 20 um begin to carry the skin along, near 0.005
FRICTIONS = (0.0, 0.001, 0.002, 0.005, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0)
COLUMNS = ("kinematics", "device", "condition", "readout", "score", "unit")


def friction_rows(scene: Scene) -> Iterator[dict[str, Any]]:
    """The columns COLUMNS of the score table of a scene with each of FRICTIONS as `friction`, on one mesh; conditions
    that cannot be solved are left out. Raises MeshError, CondensationError.
    """
    condensed = prepared(scene, edge_intervals(scene))
    for friction in FRICTIONS:
        law = replace(scene.model.contact, friction=friction)
        variant = scene.with_model(contact=law)
        for solved in solve_scene(variant, condensed, [Interface.SHEAR]):
            if isinstance(solved.solution, UnsolvedError):
                continue
            read = read_out(variant, condensed, solved.solution)
            for row in score_rows(variant, solved.condition, solved.interface, read):
                yield {column: row[column] for column in COLUMNS} | {"friction": friction}
