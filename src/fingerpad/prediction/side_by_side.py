"""Predictions of several scenes at once, each by a process of its own."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import active_children, get_context, parent_process
from threading import Thread
from typing import Any

from ..errors import ProcessError
from ..scene.scene import Scene
from .forecast import forecast, steps


def forecasts(
    tasks: Sequence[tuple[Scene, bool]], cores: int, step: Callable[[], object] = lambda: None
) -> Iterator[list[dict[str, Any]]]:
    """`forecast` of scenes, each with errors or without, in their order; on so many cores [1] as many at once.

    step: called as `forecast` does; where several are solved at once, for each as a whole. Raises ProcessError if a
    process is ended from outside.
    """
    if min(cores, len(tasks)) <= 1:
        for scene, error in tasks:
            yield forecast(scene, error, step)
        return
    # new processes know nothing of this one's threads, which those that are forked may wait for for ever
    pool = ProcessPoolExecutor(min(cores, len(tasks)), get_context("spawn"), _live_with_parent)
    try:
        for (scene, error), rows in zip(tasks, pool.map(forecast, *zip(*tasks, strict=True)), strict=True):
            for _ in range(steps(scene, error)):
                step()
            yield rows
    except BrokenProcessPool as broken:
        raise ProcessError(
            "a process that solved a scene was ended from outside, as where memory runs out; try --cores 1"
        ) from broken
    finally:  # also where this one is interrupted, or nobody asks for the rest
        pool.shutdown(wait=False, cancel_futures=True)
        for child in active_children():
            child.terminate()


def _live_with_parent() -> None:
    """Leave it to the process that began this one to end it, but do not outlive it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)  # from a thread nothing else ends the process
