"""Files that are whole or not there: written beside their place, then moved to it in one step."""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PART = ".part"  # ends the name of a file that is being written
MARK = 8  # random bytes in that name [1], so that two who write one file do not write into one another's


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path to write to, which becomes `path`, or what that is a link to, when the block ends without an error;
    otherwise nothing is left of it, and what was at `path` before stays. Raises an OSError, as `require_folder`.
    """
    require_folder(path)
    path = path.resolve()
    part = path.with_name(f"{path.name}.{secrets.token_hex(MARK)}{PART}")
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


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


def write_text(path: Path, text: str) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")
