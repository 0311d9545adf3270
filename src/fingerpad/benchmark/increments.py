"""How far scores move when load increments are made smaller."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..prediction.edges import edge_intervals
from ..prediction.scoring import condense_scene, predicted_rows
from ..readouts.accuracy import relative_changes, relative_errors, scores_by_case
from ..scene.readout import Readout
from ..scene.scene import Scene


def increment_rows(
    scene: Scene, multiples: Sequence[int], stated: Sequence[Mapping[str, Any]]
) -> Iterator[dict[str, Any]]:
    """A row for each multiple of the scene's increments and each read-out: the largest relative change of a score, the
    largest ratio of a change to the error that the score states, and how many scores change by more than that.

    stated: rows of the score table; those without a relative error are left out. Raises MeshError, CondensationError,
    ContactError.
    """
    condensed = condense_scene(scene, edge_intervals(scene))
    errors = relative_errors(stated)
    usual = scores_by_case(predicted_rows(scene, condensed))
    for multiple in multiples:
        other = scene.with_model(numerics=scene.model.numerics.with_increments(multiple))
        changes = relative_changes(scores_by_case(predicted_rows(other, condensed)), usual)
        for readout in Readout:
            own = [case for case in errors if case in changes and case[-1] == readout]
            if not own:
                continue
            ratios = [changes[case] / errors[case] for case in own]
            yield {
                "device": scene.device.name,
                "readout": str(readout),
                "times_the_increments": multiple,
                "scores": len(own),
                "largest_change": f"{max(changes[case] for case in own):.1e}",
                "largest_change_over_stated_error": round(max(ratios), 2),
                "beyond_stated_error": sum(ratio > 1.0 for ratio in ratios),
            }
