"""What increments leave in the scores."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..prediction.edges import edge_intervals
from ..prediction.scoring import condense_scene, predicted_rows
from ..readouts.accuracy import case_of, relative_errors
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
    numerics = scene.model.numerics
    first: dict[tuple[str, ...], float] = {}
    for multiple in (1, *multiples):
        rows = predicted_rows(scene.with_model(numerics=numerics.with_increments(multiple)), condensed)
        scores = {case_of(row): float(row["score"]) for row in rows}
        if not first:
            first = scores
            continue
        for readout in dict.fromkeys(case[-1] for case in scores):
            own = [case for case in errors if case in scores and case[-1] == readout]
            if not own:
                continue
            changes = {case: abs(scores[case] / first[case] - 1.0) for case in own}
            ratios = [changes[case] / errors[case] for case in own]
            yield {
                "device": scene.device.name,
                "readout": readout,
                "times_the_increments": multiple,
                "scores": len(own),
                "largest_change": f"{max(changes.values()):.1e}",
                "largest_change_over_stated_error": round(max(ratios), 2),
                "beyond_stated_error": sum(ratio > 1.0 for ratio in ratios),
            }
