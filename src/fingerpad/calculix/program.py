"""The program CalculiX, whose rules ask whether it is there."""

from __future__ import annotations

import shutil

PROGRAM = "ccx"
SKIPPED = f"skipped: {PROGRAM} not installed"  # the note of a table where it is not


def installed() -> bool:
    """Whether CalculiX can be run."""
    return shutil.which(PROGRAM) is not None
