"""Seconds that work takes, and how they grow."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

Result = TypeVar("Result")
MEBIBYTE = 2.0**20  # bytes in one
COUNTED_IN = 1.0 if sys.platform == "darwin" else 1024.0  # bytes in which the system counts peak memory


def timed(repeats: int, work: Callable[[], Result]) -> tuple[Result, list[float]]:
    """What the work returns, and the wall seconds of each repetition."""
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - start)
    return result, seconds


def fewest(repeats: int, work: Callable[[], Result]) -> tuple[Result, float]:
    """What the work returns, and the seconds of its fastest repetition: what the machine adds, it only adds."""
    result, seconds = timed(repeats, work)
    return result, min(seconds)


def peak_memory() -> float:
    """Largest memory of this process so far [MiB]."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * COUNTED_IN / MEBIBYTE)


def exponent(size: Sequence[float], seconds: Sequence[float]) -> float:
    """p of the least-squares fit of seconds = c size^p, in logarithms.

    >>> round(exponent([1.0, 2.0, 4.0], [3.0, 6.0, 12.0]), 6)
    1.0
    """
    return float(np.polyfit(np.log(size), np.log(seconds), 1)[0])
