"""Predictions of several scenes at once, each by a process of its own."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
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
    process ends early.
    """
    if min(cores, len(tasks)) <= 1:
        for scene, error in tasks:
            yield forecast(scene, error, step)
        return
    spawn = get_context("spawn")  # those that are forked may wait for ever for a thread that they do not have
    watched, lifeline = spawn.Pipe(duplex=False)
    pool = ProcessPoolExecutor(min(cores, len(tasks)), spawn, _live_on, (watched,))
    try:
        with _without_interrupts():
            begun = [pool.submit(forecast, *task) for task in tasks]
        for (scene, error), solving in zip(tasks, begun, strict=True):
            rows = solving.result()
            for _ in range(steps(scene, error)):
                step()
            yield rows
    except BrokenProcessPool as broken:
        raise ProcessError(
            "a process that was to solve a scene ended early, as where memory runs out, or in a script without"
            " `if __name__ == '__main__'`; try --cores 1"
        ) from broken
    finally:  # also where this one is interrupted, or nobody asks for the rest
        lifeline.close()
        watched.close()
        pool.shutdown()


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Processes that are begun meanwhile never see Ctrl-C, which goes to all in a terminal: this one ends them."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _live_on(watched: Connection) -> None:
    """Let this process end as soon as the other end of a pipe is closed, as by the end of the process that holds it."""
    Thread(target=_end_with, args=(watched,), daemon=True).start()


def _end_with(watched: Connection) -> None:
    watched.poll(None)
    os._exit(1)  # from a thread nothing else ends the process
