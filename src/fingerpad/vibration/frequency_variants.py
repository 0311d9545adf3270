"""Scores of vibrations under other assumptions on how tissue relaxes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..prediction.scoring import Condensed
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from ..tissue.mesh import SectionMesh
from .creep import condense_creep
from .frequency import frequency_rows
from .inertia import condense_vibrating


def _relaxation_variants(scene: Scene) -> dict[str, Scene]:
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
        name: scene.with_model(vibration=replace(scene.model.vibration, relaxation=variant))
        for name, variant in variants.items()
    }


def relaxation_rows(scene: Scene, section: SectionMesh, condensed: Condensed, frequency: float) -> list[dict[str, Any]]:
    """Rows of `frequency_rows` for shear at a frequency [Hz] under other assumptions on how tissue relaxes, each with
    its `assumption`. Raises what `condense_creep` and `condense_vibrating` raise.
    """
    return [
        {"assumption": name, **row}
        for name, variant in _relaxation_variants(scene).items()
        for row in frequency_rows(
            variant,
            condensed,
            condense_creep(section, variant),
            [condense_vibrating(section, variant, frequency)],
            Interface.SHEAR,
        )
    ]
