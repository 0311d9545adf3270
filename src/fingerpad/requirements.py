"""What a valid scene must obey, asked wherever a part of one is made."""

from __future__ import annotations

import math
import sys
from typing import Any

from .errors import SceneError


def is_number(value: Any) -> bool:
    """Whether it is a finite number; JSON Schema alone lets NaN and infinity through."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def require(condition: bool, message: str) -> None:
    """Raise SceneError with that message unless the condition holds."""
    if not condition:
        raise SceneError(message)


def require_positive(owner: str, **values: float) -> None:
    """Raise SceneError, naming owner and value, unless all values are finite and above zero."""
    for name, value in values.items():
        require(math.isfinite(value) and value > 0, f"{owner}: {name} must be a positive number, found {value}")
