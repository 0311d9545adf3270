"""How far a subcommand has come."""

from __future__ import annotations

from tqdm import tqdm


def progress(total: int, what: str = "") -> tqdm:
    """A bar of so many steps, on a terminal alone, which is cleared when it is closed. what: stands before it."""
    return tqdm(total=total, desc=what, leave=False, disable=None)
