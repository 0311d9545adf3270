"""Files that are whole or not there: written beside their place, then moved to it in one step."""

from __future__ import annotations

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PART = ".part"  # ends the name of a file that is being written


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path to write to, which becomes `path` when the block ends without an error; otherwise nothing is left of it,
    and what was at `path` before stays. Raises FileNotFoundError that names the folder if there is none.
    """
    require_folder(path)
    part = path.with_name(path.name + PART)
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def require_folder(path: Path) -> None:
    """Raise FileNotFoundError that names the folder of a file to be written if there is none."""
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "is no folder, so nothing can be written there", str(path.parent))


def write_text(path: Path, text: str) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")
