"""What a notebook or a script of one's own asks for."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import pandas as pd

from .checkout import find_checkout
from .forecast import forecast
from .validation import check_device


def predict(
    device: str | PathLike[str],
    error: bool = True,
    config: str | PathLike[str] | None = None,
    schemas: str | PathLike[str] | None = None,
) -> pd.DataFrame:
    """Scores of a device file: the columns of results/scores.csv, then `rank` and `caveats` (see `forecast`).

    error: whether to solve a second time, for `score_error`. config, schemas: those of the checkout around the
    working folder if not given. Raises SceneError, and what `forecast` raises.

    >>> predict("config/devices/device2.yaml", error=False)["rank"].max()
    3
    """
    model = Path(config) if config else find_checkout(Path.cwd()).config
    folder = Path(schemas) if schemas else find_checkout(Path.cwd()).schemas
    return pd.DataFrame(forecast(check_device(Path(device), folder, model), error))
