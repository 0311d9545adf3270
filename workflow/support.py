"""What the Snakefile needs to know about scenes, code and the commit: functions, no rules."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import re
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

PACKAGE = "fingerpad"
COMMENT = re.compile(r"#.*$|\\\n", re.MULTILINE)  # or a line that goes on
# Imports at the beginning of a line: dots, module and names, or modules. Parsing each module takes each start of
# Snakemake half a second longer
IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+(\.*)([\w.]*)[ \t]+import[ \t]*(\([^)]*\)|.+)|import[ \t]+(.+))$", re.MULTILINE
)
LEFT_BEHIND = {"__pycache__", ".ipynb_checkpoints", f"{PACKAGE}.egg-info"}  # folders that Python and Jupyter make


def reached_modules(script: Path, source: Path) -> list[str]:
    """The script, or notebook, and every module of the package that it reaches by imports, sorted: edits to these rerun
    its rule.
    """
    reached: set[Path] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in reached:
            reached.add(path)
            waiting.extend(_imported(path, source))
    return sorted(map(str, reached))


@functools.cache  # nearly all rules reach nearly the same modules
def _imported(path: Path, source: Path) -> list[Path]:
    """Files that a program imports from the package, wherever in it."""
    package = path.parent.relative_to(source).parts if path.is_relative_to(source) else ()
    modules, found = _modules(source), list[Path]()
    for line in IMPORT.finditer(COMMENT.sub("", _program(path))):
        dots, base, members, plain = line.groups()
        if plain is None:
            above = [*package[: len(package) - len(dots) + 1]] if dots else []
            base = ".".join([*above, *filter(None, [base])])
            names = [base, *(f"{base}.{name}" for name in _named(members))]
        else:
            names = _named(plain)
        for name in names:
            parts = name.split(".")
            # importing a.b.c runs a/__init__, a/b/__init__ and a/b/c, or a/b/c/__init__
            packages = ["/".join((*parts[:depth], "__init__.py")) for depth in range(1, len(parts) + 1)]
            found.extend(modules[each] for each in (*packages, f"{'/'.join(parts)}.py") if each in modules)
    return found


def _named(listed: str) -> list[str]:
    """Names that an import lists, without those that they are given."""
    return [name.split()[0] for name in listed.strip("() \t\n").split(",") if name.strip()]


@functools.cache
def _modules(source: Path) -> dict[str, Path]:
    """All modules of the package, by their paths in the folder that it lies in."""
    return {path.relative_to(source).as_posix(): path for path in (source / PACKAGE).rglob("*.py")}


def _program(path: Path) -> str:
    """The text of a module, or of a notebook's code cells."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".ipynb":
        return text
    cells = json.loads(text)["cells"]
    return "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")


def checksum(files: Iterable[str]) -> str:
    """Of what the files say, whatever their names and times."""
    return hashlib.sha256(b"".join(map(_digest, files))).hexdigest()


def checksum_of_code(program: Path, source: Path) -> str:
    """The same of a script or notebook and all modules that it reaches, as they were when the first was asked for."""
    return hashlib.sha256(b"".join(map(_digest_of_code, reached_modules(program, source)))).hexdigest()


def _digest(file: str) -> bytes:
    return hashlib.sha256(Path(file).read_bytes()).digest()


_digest_of_code = functools.cache(_digest)


def files_in(paths: Iterable[Path]) -> list[Path]:
    """The files at these paths and in the folders there, sorted, without LEFT_BEHIND."""
    files = (file for path in paths for file in (path, *path.rglob("*")) if file.is_file())
    return sorted(file for file in files if not LEFT_BEHIND & set(file.parts))


def fingerprint(*parts: Any) -> str:
    """The values (not the sources) of parts of a scene, as text: a job reruns when what it depends on changes."""
    return json.dumps([_plain(part) for part in parts], sort_keys=True)


def commit(base: Path) -> str:
    """The git commit of a checkout, marked if files differ from it; nothing without a checkout or without git."""
    if not ((base / ".git").exists() and shutil.which("git")):
        return ""
    command = ["git", "-C", str(base), "describe", "--always", "--abbrev=40", "--dirty=, with changes", "--exclude=*"]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def _plain(part: Any) -> Any:
    if dataclasses.is_dataclass(part):
        values = {field.name: _plain(getattr(part, field.name)) for field in dataclasses.fields(part)}
        return {type(part).__name__: values}
    if isinstance(part, np.ndarray):
        return _plain(part.tolist())
    if isinstance(part, (list, tuple)):
        return [_plain(child) for child in part]
    if isinstance(part, complex):
        return [part.real, part.imag]
    return part
