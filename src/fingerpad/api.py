"""What a notebook or a script of one's own asks for: tables of a device file, as the commands print them."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from numbers import Integral
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from .checkout import model_for, schemas_for
from .csvrows import listed
from .errors import UsageError
from .guess import hint
from .prediction.forces import ERROR, NORMAL, TANGENTIAL, force_rows
from .prediction.ranking import RANKS
from .prediction.side_by_side import forecasts
from .scene.problems import as_python
from .scene.scene import Scene
from .scene.tissue_law import Kinematics
from .scene.validation import check_device, possible
from .scene.variation import NO_VALUES, variants
from .vibration.forecast import at_frequencies, vibration_forecast

# columns of numbers, which are NaN where they are not known
PREDICTED = ("score", "score_error", "indentation_mm", "force_N_per_mm", "sliding_share", "time")
FORCES = ("time", "x_mm", NORMAL, TANGENTIAL, ERROR)
VIBRATED = ("score", "inertia")


def predict(
    device: str | PathLike[str],
    error: bool = True,
    kinematics: str = "small",
    config: str | PathLike[str] | None = None,
    schemas: str | PathLike[str] | None = None,
    vary: Mapping[str, Sequence[Any]] = NO_VALUES,
    conditions: Iterable[str] = (),
    cores: int = 1,
) -> pd.DataFrame:
    """Scores of a device file: the columns of results/scores.csv, then `rank`, `first_rank`, `last_rank`,
    `indentation_mm`, `force_N_per_mm`, `sliding_share`, `time`, `time_unit` and `caveats` (see `forecast`), a tuple of
    sentences; `note` has the same as one text, or says why there is no score.

    vary: values to take in turn in place of those at some keys of the scene files, in all combinations; each key is a
    column in front, in which lists are tuples. Combinations that cannot be are left out, with a warning, if each of
    their values is possible in another one. error: whether to solve a coarser scene as well, for `score_error`.
    kinematics: "small" or "finite". conditions: names of those that are predicted alone, on a mesh made for them
    (default: all). config: the config.yaml beside the device file's folder if not given, or else that of the checkout
    around the working folder. schemas: those that fingerpad comes with if not given. cores: how many combinations are
    solved at once, each by a process of its own; a script then needs `if __name__ == "__main__":`. Numbers that are not
    known are NaN, and such ranks NA. Raises SceneError, and UsageError if there is no such checkout, if what is varied
    has no effect (`require_effect`), and for a parameter that is of another kind; and ProcessError if a process ends
    early.

    >>> int(predict("config/devices/device2.yaml", error=False)["rank"].max())
    3
    """
    names = _names(conditions)
    _require("error", error, isinstance(error, bool | np.bool_), "True or False")
    _require("cores", cores, isinstance(cores, Integral) and cores > 0, "a whole number, at least 1")
    cases, refused = possible(variants(vary), lambda values: _checked(device, config, schemas, kinematics, values))
    for why in refused:
        warnings.warn(f"left out: {why}", stacklevel=2)
    tasks = [(scene.with_asked(names), bool(error)) for _, scene in cases]
    tables = zip(cases, forecasts(tasks, cores), strict=True)
    rows = [_hashable(values) | row for (values, _), table in tables for row in table]
    return _table(rows, PREDICTED).astype(dict.fromkeys(RANKS, "Int64"))


def forces(
    device: str | PathLike[str],
    error: bool = True,
    kinematics: str = "small",
    config: str | PathLike[str] | None = None,
    schemas: str | PathLike[str] | None = None,
    conditions: Iterable[str] = (),
) -> pd.DataFrame:
    """Forces with which every actuator acts on the skin [N per mm of finger], at every time of every condition of a
    device file: the columns that `force_rows` names. Parameters and errors are those of `predict`.

    >>> pressed = forces("config/devices/device2.yaml", error=False, conditions=["alternate_000"]).query("time == 0")
    >>> bool(pressed["normal_N_per_mm"].min() > 0.0)
    True
    """
    names = _names(conditions)
    _require("error", error, isinstance(error, bool | np.bool_), "True or False")
    scene = _checked(device, config, schemas, kinematics, NO_VALUES)
    return _table(force_rows(scene.with_asked(names), bool(error)), FORCES)


def vibrate(
    device: str | PathLike[str],
    frequencies: Iterable[float] = (),
    config: str | PathLike[str] | None = None,
    schemas: str | PathLike[str] | None = None,
    conditions: Iterable[str] = (),
) -> pd.DataFrame:
    """Scores of a device file's conditions as vibrations, slow and at some frequencies [Hz], or those in the file: the
    columns of results/frequency.csv, then `caveats`. Other parameters and errors are those of `predict`; UsageError
    also if displacements are given in time, if there is no frequency, and if one is out of range.
    """
    listing = isinstance(frequencies, Iterable) and not isinstance(frequencies, str | bytes | Mapping)
    _require("frequencies", frequencies, listing and getattr(frequencies, "ndim", 1) == 1, "a list of numbers [Hz]")
    scene = _checked(device, config, schemas, Kinematics.SMALL, NO_VALUES).with_asked(_names(conditions))
    wanted = [each.item() if hasattr(each, "item") else each for each in frequencies]  # numpy's numbers as Python's
    return _table(vibration_forecast(at_frequencies(scene, wanted)), VIBRATED)


def _checked(
    device: str | PathLike[str],
    config: str | PathLike[str] | None,
    schemas: str | PathLike[str] | None,
    kinematics: str,
    values: Mapping[str, Any],
) -> Scene:
    """The scene of a device file with some values in place of those in files. Raises SceneError, UsageError."""
    _require("device", device, isinstance(device, str | PathLike), "the path of one device file")
    for name, path in (("config", config), ("schemas", schemas)):
        _require(name, path, path is None or isinstance(path, str | PathLike), "a path, or None")
    known = isinstance(kinematics, str) and kinematics in list(Kinematics)
    _require("kinematics", kinematics, known, listed(Kinematics))
    model = model_for(Path(device), Path(config) if config else None)
    scene = check_device(Path(device), schemas_for(Path(schemas) if schemas else None), model, values)
    return scene.with_kinematics(Kinematics(kinematics))


def _names(conditions: Iterable[str]) -> tuple[str, ...]:
    """Names of conditions. Raises UsageError if they are no list of texts."""
    meant = hint(f"[{conditions!r}]") if isinstance(conditions, str) else ""
    listing = isinstance(conditions, Iterable) and not isinstance(conditions, str | bytes)
    names = tuple(conditions) if listing else ()
    _require(
        "conditions", conditions, listing and all(isinstance(each, str) for each in names), f"a list of names{meant}"
    )
    return names


def _require(name: str, found: object, fits: bool, allowed: str) -> None:
    """Raise UsageError, with the name of a parameter, unless what was given fits."""
    if not fits:
        raise UsageError(f"{name}: found {as_python(found)}; allowed: {allowed}")


def _hashable(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values whose lists are tuples, so that tables can be grouped by them."""
    return {key: _frozen(value) for key, value in values.items()}


def _frozen(value: Any) -> Any:
    return tuple(map(_frozen, value)) if isinstance(value, list) else value


def _table(rows: Sequence[Mapping[str, Any]], numbers: Iterable[str]) -> pd.DataFrame:
    """Rows as a table with some columns of numbers."""
    return pd.DataFrame(rows).astype(dict.fromkeys(numbers, "float64"))
