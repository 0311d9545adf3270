"""Run time against error of CalculiX, on a ladder of meshes of one condition."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..calculix.case import Case
from ..calculix.crosscheck import calculix_outcome, deck_inputs, differences, on_deck
from ..prediction.edges import mesh_device
from ..scene.device import Condition
from ..scene.readout import Readout
from ..scene.scene import Scene
from .ladders import CALCULIX_LADDER


def calculix_ladder(
    scene: Scene, condition: Condition, factors: Sequence[float], case: Case, folder: Path, limit: float
) -> list[dict[str, Any]]:
    """A row for each coarsening of the skin's mesh but the finest, from coarse to fine: seconds of CalculiX, and errors
    of its scores against its own on the finest mesh. All columns of seconds are the same, as a further condition costs
    it as much as the first.

    Raises what `crosscheck.deck_inputs` raises, CalculixError if a deck fails or takes longer than limit [s], and
    MeshError if a mesh cannot be had.
    """
    fine, settings = deck_inputs(scene, case)
    climbed = []
    for factor in sorted(factors, reverse=True):
        other = on_deck(fine, factor)
        section = mesh_device(other)
        outcome, seconds = calculix_outcome(other, section, condition, settings, folder / f"{factor:g}", limit)
        climbed.append((factor, section, outcome, seconds))
    _, _, finest, _ = climbed[-1]
    rows = []
    for factor, section, outcome, seconds in climbed[:-1]:
        apart = differences(outcome, finest)
        rows.append(
            {
                "kinematics": str(case.kinematics),
                "solver": CALCULIX_LADDER,
                "coarsening": factor,
                "unknowns": section.unknowns,
                "cold_s": round(seconds, 1),
                "warm_s": round(seconds, 1),
                "stimulus_s": round(seconds, 1),
                **{f"error_{readout}": f"{apart[f'score_{readout}']:.2e}" for readout in Readout},
            }
        )
    return rows
