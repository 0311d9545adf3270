"""Scores between the phases at which a device is tried: the same stimuli at phases in equal steps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..readouts.scorings import both_motions
from ..scene.contact_law import Interface
from ..scene.scene import with_all_kinematics
from ..scene.validation import check_device
from .forecast import forecast

PHASES = [15.0 * step for step in range(13)]  # deg: from 0 to 180; source: six steps between those that are shipped
COLUMNS = ("kinematics", "device", "dispersion", "phase_deg", "readout", "score", "score_error", "unit", "note")


def phase_rows(device: Path, schemas: Path, config: Path) -> Iterator[dict[str, Any]]:
    """The columns COLUMNS of the score table of a device with shear at all PHASES, with each kinematics that it is
    predicted with, and `motion_mm`, both motions of the drive alone (`readouts.scorings`). Without a prediction the
    score is None. device: a file with `stimulus.phases`. Raises SceneError if it has none.
    """
    scene = check_device(device, schemas, config, {"stimulus.phases": PHASES})
    with_shear = scene.with_device(frictionless=False)
    for each in with_all_kinematics([with_shear]):
        for row in forecast(each):
            if row["interface"] == Interface.SHEAR:
                motion = both_motions(scene.device.condition(row["condition"]))
                yield {column: row[column] for column in COLUMNS} | {"motion_mm": motion}
