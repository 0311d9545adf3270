"""What a report was made with and from: versions and checksums, nothing that differs between identical runs."""

from __future__ import annotations

import hashlib
import platform
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")  # of a package, at the start of a requirement


@dataclass(frozen=True)
class Provenance:
    """Version of this project, its git commit ("" without one), Python's version, those of the packages it needs, and
    the SHA-256 of files by folder and name.
    """

    project: str
    commit: str
    python: str
    packages: tuple[tuple[str, str], ...]
    files: tuple[tuple[str, str], ...]


def provenance(pyproject: Path, commit: str, files: Sequence[Path]) -> Provenance:
    """Provenance of a run with the packages that a pyproject.toml names, from some files."""
    project = tomllib.loads(pyproject.read_text(encoding="utf-8"))["project"]
    names = [found[0] for text in project["dependencies"] if (found := NAME.match(text))]
    return Provenance(
        project["version"],
        commit,
        platform.python_version(),
        tuple((name, version(name)) for name in sorted(names)),
        tuple((f"{path.parent.name}/{path.name}", hashlib.sha256(path.read_bytes()).hexdigest()) for path in files),
    )
