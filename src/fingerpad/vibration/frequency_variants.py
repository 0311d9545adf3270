"""Scores of vibrations under other assumptions on how tissue relaxes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..contact.linear_solution import Indented
from ..errors import ContactError
from ..prediction.scoring import Condensed
from ..readouts.roughness import NO_PREDICTION
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..tissue.mesh import SectionMesh
from .creep import condense_creep
from .frequency import certified_vibration, vibration_scores


def relaxation_variants(scene: Scene) -> dict[str, Scene]:
    """The scene with other assumptions on how tissue relaxes, by name; the scene itself first."""
    relaxation = scene.model.vibration.relaxation
    deep = tuple(layer.name for layer in scene.model.finger.pad[scene.model.layers_above :])
    left = 1.0 - sum(relaxation.shares)
    more = (1.0 - left / 2.0) / (1.0 - left)
    variants = {
        "as in config.yaml": relaxation,
        "only layers below the receptors relax": replace(relaxation, layers=deep),
        "half as much relaxes": replace(relaxation, shares=tuple(share / 2.0 for share in relaxation.shares)),
        "half as much is left": replace(relaxation, shares=tuple(more * share for share in relaxation.shares)),
        "the fastest alone relaxes": replace(
            relaxation, shares=(sum(relaxation.shares),), times=(min(relaxation.times),)
        ),
    }
    return {
        name: replace(scene, model=replace(scene.model, vibration=replace(scene.model.vibration, relaxation=variant)))
        for name, variant in variants.items()
    }


def variant_rows(
    scene: Scene, section: SectionMesh, condensed: Condensed, indented: Indented, frequency: float
) -> list[dict[str, Any]]:
    """Scores of all conditions at a frequency [Hz] under other assumptions on how tissue relaxes, one row each; a note
    where a path cannot be followed. Raises what `condense_creep` raises.
    """
    rows = []
    for name, variant in relaxation_variants(scene).items():
        creep = condense_creep(section, variant)
        for cycle in scene.device.cycles:
            scores: dict[Readout, float] = {}
            note = ""
            try:
                vibration = certified_vibration(variant, condensed, creep, indented, cycle, frequency)
                scores = vibration_scores(variant, condensed, vibration)
            except ContactError as error:
                note = f"{NO_PREDICTION}: {error}"
            rows.append(
                {
                    "device": scene.device.name,
                    "condition": cycle.name,
                    "frequency_hz": frequency,
                    "assumption": name,
                    **{str(each): scores.get(each) for each in Readout},
                    "note": note,
                }
            )
    return rows
