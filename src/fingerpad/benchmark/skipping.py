"""What each skip saves, and how far scores move when it is off."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import Any

from ..arrays import FloatArray
from ..contact.linear_solution import indent_device, stimulate
from ..fields.recovery import recover_displacement
from ..fields.states import states_fields
from ..prediction.edges import edge_intervals
from ..prediction.scoring import condense_scene, predicted_rows, prepared
from ..readouts.accuracy import relative_changes, relative_error, scores_by_case
from ..readouts.strain import read_receptors
from ..scene.contact_law import Interface
from ..scene.numerics import Skips
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.mesh import SectionMesh, mesh_section
from .timing import fewest

Row = dict[str, Any]
MIRRORED = ("halved_condensation", "mirrored_half")  # of rows that mirror alone
NOT_FINITE = ("halved_condensation", "frictionless_path")  # nothing is condensed at rest, and every path is followed


@dataclass(frozen=True)
class _Measured:
    """Seconds of set-up and of all conditions, and scores by case."""

    setup: float
    conditions: float
    scores: dict[tuple[str, ...], float]


def skip_rows(scene: Scene, stated: Sequence[Mapping[str, Any]], repeats: int) -> Iterator[Row]:
    """A row for each switch of `skips` that finds something to skip in the scene: seconds of set-up and of all
    conditions with it off, over those with all on; the largest relative difference of any score; and the smallest error
    that a score of the device states.

    stated: rows of the score table. With finite kinematics set-up is the mesh alone. Raises MeshError,
    CondensationError, ContactError.
    """
    relative = (
        relative_error(row)
        for row in stated
        if (row["kinematics"], row["device"]) == (scene.kinematics, scene.device.name)
    )
    smallest = min((error for error in relative if not math.isnan(error)), default=float("nan"))
    switches = [switch.name for switch in fields(Skips) if _finds_something(switch.name, scene)]
    on, *off = _in_turn([scene, *(_without(scene, switch) for switch in switches)], repeats)
    for switch, other in zip(switches, off, strict=True):
        moved = max(relative_changes(other.scores, on.scores).values(), default=0.0)
        yield {
            "kinematics": str(scene.kinematics),
            "device": scene.device.name,
            "skip": switch,
            "setup_ratio": round(other.setup / on.setup, 2),
            "conditions_ratio": round(other.conditions / on.conditions, 2),
            "total_ratio": round((other.setup + other.conditions) / (on.setup + on.conditions), 2),
            "largest_difference": f"{moved:.1e}",
            "smallest_stated_error": f"{smallest:.1e}",
        }


def always_rows(scene: Scene, repeats: int) -> Iterator[Row]:
    """Rows of what no switch turns on or off: what the full field, which is left out, and one of both read-outs, which
    are always computed, cost, and how many nodes lie in dorsal tissue; each as a ratio `of` what its row says.

    Raises as `skip_rows`.
    """
    edges = edge_intervals(scene)
    condensed, section = condense_scene(scene, edges), mesh_section(scene, edges)
    indented = indent_device(scene, condensed.section, condensed.body, Interface.SHEAR)
    condition = scene.device.conditions[-1]
    solution, seconds = fewest(repeats, partial(stimulate, scene, indented, condition))
    _, recovering = fewest(
        repeats, lambda: states_fields(scene, section, recover_displacement(section, scene, solution.force))
    )
    forces, finger = solution.force, condensed.section
    _, reading_both = fewest(repeats, lambda: read_receptors(finger.receptor_strain(forces), finger.arc))
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


def _finds_something(switch: str, scene: Scene) -> bool:
    """Whether a skip can save anything in a scene."""
    device, finite = scene.device, scene.kinematics is Kinematics.FINITE
    if switch == "equal_stimuli":
        return len(device.distinct_conditions) < len(device.conditions)
    if switch == "shared_indentation":
        return len(device.conditions) > 1
    if switch in MIRRORED and not device.actuators.mirrors:
        return False
    if switch == "frictionless_path" and Interface.FRICTIONLESS not in device.interfaces():
        return False
    return not (finite and switch in NOT_FINITE)


def _without(scene: Scene, switch: str) -> Scene:
    """The scene with one skip off."""
    return scene.with_model(skips=replace(scene.model.skips, **{switch: False}))


def _in_turn(scenes: Sequence[Scene], repeats: int) -> list[_Measured]:
    """The fastest of several rounds through all scenes, for each: a machine's speed drifts, for all alike."""
    edges = edge_intervals(scenes[0])
    rounds = [[_measured(scene, edges) for scene in scenes] for _ in range(repeats)]
    return [
        replace(own[0], setup=min(each.setup for each in own), conditions=min(each.conditions for each in own))
        for own in zip(*rounds, strict=True)
    ]


def _measured(scene: Scene, edges: FloatArray) -> _Measured:
    """Set-up and conditions of one scene, once."""
    condensed, setup = fewest(1, partial(prepared, scene, edges))
    rows, conditions = fewest(1, partial(predicted_rows, scene, condensed))
    return _Measured(setup, conditions, scores_by_case(rows))
