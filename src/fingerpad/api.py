"""What a notebook or a script of one's own asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import pandas as pd

from .checkout import model_for, schemas_for
from .csvrows import listed
from .errors import UsageError
from .guess import hint
from .prediction.forecast import forecast
from .prediction.ranking import RANKS
from .scene.tissue_law import Kinematics
from .scene.validation import check_device, require_effect
from .scene.variation import NO_VALUES, variants

NUMBERS = ("score", "score_error", "indentation_mm", "force_N_per_mm", "sliding_share", "time")


def predict(
    device: str | PathLike[str],
    error: bool = True,
    kinematics: str = "small",
    config: str | PathLike[str] | None = None,
    schemas: str | PathLike[str] | None = None,
    vary: Mapping[str, Sequence[Any]] = NO_VALUES,
    conditions: Sequence[str] = (),
) -> pd.DataFrame:
    """Scores of a device file: the columns of results/scores.csv, then `rank`, `first_rank`, `last_rank`,
    `indentation_mm`, `force_N_per_mm`, `sliding_share`, `time`, `time_unit` and `caveats` (see `forecast`).

    vary: values to take in turn in place of those at some keys of the scene files, in all combinations; each key is a
    column in front. error: whether to solve a coarser scene as well, for `score_error`. kinematics: "small" or
    "finite". conditions: names of those that are predicted alone, on a mesh made for them (default: all). config: the
    config.yaml beside the device file's folder if not given, or else that of the checkout around the working folder, as
    are schemas. Numbers that are not known are NaN, and such ranks NA. Raises SceneError, and UsageError if there is no
    such checkout or there are no such kinematics, if what is varied has no effect (`require_effect`), if conditions are
    a text, and if the device is no path.

    >>> int(predict("config/devices/device2.yaml", error=False)["rank"].max())
    3
    """
    if not isinstance(device, str | PathLike):
        raise UsageError(f"device: found {device!r}; allowed: the path of one device file")
    if isinstance(conditions, str):
        raise UsageError(f"conditions: found {conditions!r}; allowed: a list of names{hint(f'[{conditions!r}]')}")
    if kinematics not in list(Kinematics):
        raise UsageError(f"kinematics: found {kinematics!r}; allowed: {listed(Kinematics)}")
    model = model_for(Path(device), Path(config) if config else None)
    folder = schemas_for(Path(schemas) if schemas else None)
    cases = [(values, check_device(Path(device), folder, model, values)) for values in variants(vary)]
    require_effect([values for values, _ in cases], [scene for _, scene in cases])
    rows = [
        values | row
        for values, scene in cases
        for row in forecast(scene.with_asked(conditions).with_kinematics(Kinematics(kinematics)), error)
    ]
    return pd.DataFrame(rows).astype(dict.fromkeys(NUMBERS, "float64") | dict.fromkeys(RANKS, "Int64"))
