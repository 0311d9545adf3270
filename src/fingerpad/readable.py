"""What may be read of what users name as a file."""

from __future__ import annotations

from pathlib import Path

from .errors import FingerpadError


def require_ending(path: Path, most: int, kind: str, error: type[FingerpadError]) -> None:
    """Raise `error` if what a user wants read is no file that ends, as a pipe, or one of more than so many bytes; an
    OSError if it is not there. kind: of file that is allowed, in words.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise error(f"{path}: is no file that ends; allowed: a {kind} file")
    if (size := path.stat().st_size) > most:
        raise error(f"{path}: found {size} bytes; allowed: at most {most}")
