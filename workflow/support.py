"""What the Snakefile needs to know about scenes, code and the commit: functions, no rules."""

from __future__ import annotations

import ast
import dataclasses
import functools
import hashlib
import json
import re
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

PACKAGE = "fingerpad"
MAGIC = re.compile(r"^(\s*)[%!].*$", re.MULTILINE)  # a line for IPython or the shell, in a notebook
LEFT_BEHIND = {"__pycache__", ".ipynb_checkpoints", f"{PACKAGE}.egg-info"}  # folders that Python and Jupyter make


def reached_modules(script: Path, source: Path) -> list[str]:
    """The script, or notebook, and every module of the package that it reaches by imports, sorted: edits to these rerun
    its rule.
    """
    reached: set[Path] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path in reached:
            continue
        reached.add(path)
        package = path.parent.relative_to(source).parts if path.is_relative_to(source) else ()
        waiting.extend(_imported(_program(path), package, source))
    return sorted(str(path) for path in reached)


@functools.cache  # nearly all rules reach nearly the same modules
def _imported(program: str, package: tuple[str, ...], source: Path) -> list[Path]:
    """Files that the text of a program, part of a package, imports from the package."""
    found: list[Path] = []
    for node in _statements(ast.parse(program)):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join((*above, node.module) if node.module else above)
            names = [base] + [f"{base}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            if parts[0] != PACKAGE:
                continue
            # importing a.b.c runs a/__init__, a/b/__init__ and a/b/c, or a/b/c/__init__
            packages = ["/".join((*parts[:depth], "__init__.py")) for depth in range(1, len(parts) + 1)]
            known = _modules(source)
            found.extend(known[name] for name in (*packages, f"{'/'.join(parts)}.py") if name in known)
    return found


@functools.cache
def _modules(source: Path) -> dict[str, Path]:
    """All modules of the package, by their paths in the folder that it lies in."""
    return {path.relative_to(source).as_posix(): path for path in (source / PACKAGE).rglob("*.py")}


def _statements(tree: ast.Module) -> Iterator[ast.AST]:
    """All statements, within others too; expressions, which are most of a tree, hold none."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        within = (ast.stmt, ast.excepthandler, ast.match_case)
        waiting.extend(child for child in ast.iter_child_nodes(node) if isinstance(child, within))


def _program(path: Path) -> str:
    """The text of a module, or of a notebook's code cells."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".ipynb":
        return text
    cells = json.loads(text)["cells"]
    program = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    return MAGIC.sub(r"\1pass", program)


def checksum(files: Iterable[str]) -> str:
    """Of what the files say, whatever their names and times."""
    digests = (hashlib.sha256(Path(file).read_bytes()).digest() for file in files)
    return hashlib.sha256(b"".join(digests)).hexdigest()


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
