"""Files that are whole or not there: written beside their place, then moved to it in one step. And what may be read."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from .errors import FingerpadError

PART = ".part"  # ends the name of a file that is being written
MARK = 8  # random bytes in that name [1], so that two who write one file do not write into one another's


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path to write to, which becomes `path`, or what that is a link to, when the block ends without an error;
    otherwise nothing is left of it, and what was at `path` before stays. What killed writers of `path` left goes away,
    where files can be locked and it may be removed. Raises an OSError, as `require_folder`.
    """
    require_folder(path)
    path = path.resolve()
    _sweep(path)
    part, held = _begin(path)
    with held:
        try:
            yield part
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)


def _begin(path: Path) -> tuple[Path, BinaryIO]:
    """A new part of a file, and what holds it locked until it is closed, as by the end of the process: so others know
    that it is written.
    """
    while True:
        part = path.with_name(f"{path.name}.{secrets.token_hex(MARK)}{PART}")
        held = part.open("xb")
        with suppress(OSError):  # on a file system without locks
            fcntl.flock(held, fcntl.LOCK_EX)
        if os.fstat(held.fileno()).st_nlink:  # else another writer has swept it before it was locked
            return part, held
        held.close()


def _sweep(path: Path) -> None:
    """Remove parts of a file that nobody writes any more."""
    ours = re.compile(rf"{re.escape(path.name)}\.[0-9a-f]{{{2 * MARK}}}{re.escape(PART)}")
    with suppress(OSError):  # a folder whose files may not be listed
        for part in [each for each in path.parent.iterdir() if ours.fullmatch(each.name)]:
            with suppress(OSError), part.open("rb") as left:  # locked, or another user's
                fcntl.flock(left, fcntl.LOCK_EX | fcntl.LOCK_NB)
                part.unlink()


def require_folder(path: Path) -> None:
    """Raise an OSError that names the folder of a file to be written if there is none, or nothing may be written there,
    and the file if a folder has its name, or anything else that is no file.
    """
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "is no folder, so nothing can be written there", str(path.parent))
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a folder, so no file can be written there", str(path))
    if path.exists() and not path.is_file():
        raise OSError(errno.EINVAL, "is no regular file, so it cannot be replaced by one", str(path))
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, "is a folder in which you may not write", str(path.parent))


def require_readable(path: Path, most: int, kind: str, error: type[FingerpadError]) -> None:
    """Raise `error` if what a user wants read is no file that ends, as a pipe, or one of more than so many bytes; an
    OSError if it is not there. kind: of file that is allowed, in words.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise error(f"{path}: is no file that ends; allowed: a {kind} file")
    if (size := path.stat().st_size) > most:
        raise error(f"{path}: found {size} bytes; allowed: at most {most}")


def write_text(path: Path, text: str) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")
