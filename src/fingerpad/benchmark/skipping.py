"""What each skip saves, and how far scores move when it is off."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from ..accuracy import CASE, has_error
from ..contact_law import Interface
from ..edges import edge_intervals
from ..mesh import SectionMesh, mesh_section
from ..numerics import Skips
from ..prediction import condense_scene, predicted_rows, prepared
from ..recovery import recover_displacement
from ..scene import Scene
from ..solution import indent_device, stimulate
from ..states import states_fields
from ..strain import receptor_readouts
from ..tissue_law import Kinematics
from .timing import fewest

Row = dict[str, Any]


NOT_FINITE = ("halved_condensation", "frictionless_path")  # nothing is condensed at rest, and every path is followed


def skip_rows(scene: Scene, stated: Sequence[Mapping[str, Any]], repeats: int) -> Iterator[Row]:
    """A row for each switch of `skips` that the scene's kinematics know: seconds of set-up and of all conditions with
    it off, over those with all on; the largest relative difference of any score; and the smallest error that a score
    of the device states.

    stated: rows of the score table. With finite kinematics set-up is the mesh alone.
    """
    edges = edge_intervals(scene)
    relative = (
        float(row["score_error"]) / float(row["score"])
        for row in stated
        if (row["kinematics"], row["device"]) == (scene.kinematics, scene.device.name) and has_error(row)
    )
    smallest = min(relative, default=float("nan"))
    setup, conditions, scores = _measured(scene, edges, repeats)
    for switch in fields(Skips):
        if scene.kinematics is Kinematics.FINITE and switch.name in NOT_FINITE:
            continue
        skips = replace(scene.model.skips, **{switch.name: False})
        other = replace(scene, model=replace(scene.model, skips=skips))
        setup_without, conditions_without, moved = _measured(other, edges, repeats)
        yield {
            "kinematics": str(scene.kinematics),
            "device": scene.device.name,
            "skip": switch.name,
            "setup_ratio": round(setup_without / setup, 2),
            "conditions_ratio": round(conditions_without / conditions, 2),
            "total_ratio": round((setup_without + conditions_without) / (setup + conditions), 2),
            "largest_difference": f"{max(abs(moved[case] / scores[case] - 1.0) for case in scores):.1e}",
            "smallest_stated_error": f"{smallest:.1e}",
        }


def always_rows(scene: Scene, repeats: int) -> Iterator[Row]:
    """What is left out whatever the switches say, or is not left out, as a ratio `of` something."""
    edges = edge_intervals(scene)
    condensed, section = condense_scene(scene, edges), mesh_section(scene, edges)
    indented = indent_device(scene, condensed.section, condensed.body, Interface.SHEAR)
    condition = scene.device.conditions[-1]
    solution, seconds = fewest(repeats, partial(stimulate, scene, condensed.section, indented, condition))
    _, recovering = fewest(
        repeats, lambda: states_fields(scene, section, recover_displacement(section, scene, solution.force[-1:]))
    )
    forces = np.stack([solution.indented_force, *solution.force])
    _, reading_both = fewest(repeats, lambda: receptor_readouts(condensed.section.receptor_strain(forces)))
    for what, extra in (("full field", recovering), ("one more read-out", reading_both / 2.0)):
        yield {
            "device": scene.device.name,
            "what": what,
            "ratio": round(extra / seconds, 3),
            "of": "seconds of a stimulus",
        }
    yield {
        "device": scene.device.name,
        "what": "dorsal tissue",
        "ratio": _dorsal_share(section, scene),
        "of": "all nodes",
    }


def _dorsal_share(section: SectionMesh, scene: Scene) -> float:
    """Share [1] of the nodes that lie in the dorsal half of the finger."""
    return round(float((section.mesh.doflocs[1] > scene.model.finger.height / 2.0).mean()), 3)


def _measured(scene: Scene, edges: Any, repeats: int) -> tuple[float, float, dict[tuple[str, ...], float]]:
    """Seconds of set-up and of all conditions, and scores by case."""
    condensed, setup = fewest(repeats, partial(prepared, scene, edges))
    rows, conditions = fewest(repeats, partial(predicted_rows, scene, condensed))
    return setup, conditions, {tuple(str(row[key]) for key in CASE): row["score"] for row in rows}
