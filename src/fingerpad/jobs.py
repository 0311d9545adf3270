"""Jobs of the workflow: how they end where something goes wrong."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from .errors import FingerpadError


@contextmanager
def logged(logs: Sequence[str]) -> Iterator[None]:
    """Write to the job's logs why it fails, and end it with status 1: at a FingerpadError with its message alone, there
    and on standard error; at any other error with the traceback.
    """
    try:
        yield
    except FingerpadError as error:
        _append(logs, f"{error}\n")
        sys.exit(f"fingerpad: {error}")
    except Exception:
        _append(logs, traceback.format_exc())
        raise


def _append(logs: Sequence[str], text: str) -> None:
    for log in logs:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(text)
