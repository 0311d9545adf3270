"""Scene files as they are when a run of the workflow begins: its jobs read the same, or end.

What a job depends on is recorded as it was when the run began. A file that is edited while the run goes on, and put
back, would leave results of the edit that nothing makes again.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from importlib import import_module
from pathlib import Path

from .errors import SceneError

VARIABLE = "FINGERPAD_BEGUN"  # of the environment, in which jobs find what their run began with
LONGEST = 100_000  # characters [1] of it; source: Linux takes 131072. With more files than that nothing is compared
DIGEST = 8  # bytes [1]; source: chosen. Nobody tries to make two files alike

Checksums = Mapping[str, tuple[str, str]]  # by file: of its bytes, and of its values


def begun(files: Iterable[Path]) -> Checksums:
    """Checksums of some scene files. Raises SceneError as `read_yaml`."""
    return {str(path): (_of_bytes(path), _of_values(path)) for path in files}


def remember(known: Checksums) -> None:
    """Put into the environment what the jobs of this run compare with."""
    text = json.dumps(known)
    os.environ[VARIABLE] = text if len(text) <= LONGEST else "{}"


def require_unchanged(files: Iterable[str]) -> None:
    """Raise SceneError if one of the files is one that is remembered, and has other values than then."""
    known = json.loads(os.environ.get(VARIABLE, "{}"))
    for name in files:
        if name in known:
            path, (whole, values) = Path(name), known[name]
            if _of_bytes(path) != whole and _of_values(path) != values:
                raise SceneError(f"{name}: has changed since this run began; run again")


def _of_bytes(path: Path) -> str:
    """Checksum of a file; of nothing where it is gone."""
    return _checksum(path.read_bytes() if path.is_file() else b"")


def _of_values(path: Path) -> str:
    """Checksum of the values in a scene file, without comments and sources; of any other file that of its bytes."""
    if path.suffix != ".yaml":
        return _of_bytes(path)
    # by name, as no job need run again for what it says (decision 26), and only where a file has changed
    scenefile, yamlfile = (import_module(f".scene.{each}", __package__) for each in ("scenefile", "yamlfile"))
    values = scenefile.plain_values(yamlfile.read_yaml(path))
    return _checksum(json.dumps(values, sort_keys=True, default=str).encode())


def _checksum(content: bytes) -> str:
    return hashlib.blake2b(content, digest_size=DIGEST).hexdigest()
