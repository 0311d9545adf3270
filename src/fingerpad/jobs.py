"""Jobs of the workflow: how they end where an error is expected."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from .errors import FingerpadError


@contextmanager
def plain_errors(logs: Sequence[str]) -> Iterator[None]:
    """End the job with status 1 at a FingerpadError, with its message alone in the job's logs and on standard error."""
    try:
        yield
    except FingerpadError as error:
        for log in logs:
            with Path(log).open("a", encoding="utf-8") as file:
                file.write(f"{error}\n")
        sys.exit(f"fingerpad: {error}")
