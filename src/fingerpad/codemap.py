"""A map of the code, made from it: modules with what they import, rules with what their scripts do."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import PurePosixPath

from .digraph import reduced
from .markdown import table

RULE = re.compile(r"^ *rule (\w+):", re.MULTILINE)
INTRODUCTION = """\
# Map of the code

Written by `snakemake docs` from imports and docstrings; edit those, not this page. [The model](model.md) leads from a
figure to the function and the equation behind it.

A run goes from rule to script to library. A **rule** (`workflow/rules/`) names inputs, outputs and the values of the
scene that it depends on. Its **script** (`workflow/scripts/`, of the same name) reads, calls the library and writes.
The **library** (`src/fingerpad/`) knows nothing of Snakemake. `workflow/support.py` tells the Snakefile which modules a
script reaches, and so what an edit reruns. Scene files are checked against `workflow/schemas/`; templates of pages are
in `workflow/pages/` and `workflow/report/`.
"""
MODULES = """\
## Modules

Imports point one way: a module imports modules of lower levels alone. What other imports imply is left out, and so are
imports from the packages below.
"""


def page(modules: Mapping[str, str], rules: Mapping[str, str], scripts: Mapping[str, str]) -> str:
    """Markdown page of the code. All arguments are texts: modules by path in the package, the others by stem."""
    single = {PurePosixPath(path).stem: text for path, text in modules.items() if "/" not in path}
    single.pop("__init__", None)
    edges = [(other, name) for name, text in single.items() for other in imported(text) if other in single]
    level = levels(single, edges)
    shown: dict[str, list[str]] = {name: [] for name in single}
    for other, name in reduced(edges):
        shown[name].append(f"`{other}`")
    parts = [
        INTRODUCTION,
        MODULES,
        table(
            ("level", "module", "what", "imports"),
            [
                (level[name], f"`{name}`", summary(single[name]), ", ".join(sorted(shown[name])))
                for name in sorted(single, key=lambda name: (level[name], name))
            ],
        )
        + "\n",
    ]
    for package in sorted({path.split("/")[0] for path in modules if "/" in path}):
        inside = {path: text for path, text in sorted(modules.items()) if path.startswith(f"{package}/")}
        rows = [
            (f"`{PurePosixPath(path).stem}`", summary(text)) for path, text in inside.items() if "__init__" not in path
        ]
        parts.append(f"### `{package}/`\n\n{summary(inside[f'{package}/__init__.py'])}\n")
        parts.append(table(("module", "what"), rows) + "\n")
    parts.append("## Rules\n\nA rule without a script gathers targets or copies a file.\n")
    for stem, text in sorted(rules.items()):
        said = [(f"`{name}`", summary(scripts[name]) if name in scripts else "") for name in RULE.findall(text)]
        if said:
            parts.append(f"### `{stem}.smk`\n")
            parts.append(table(("rule", "its script"), said) + "\n")
    return "\n".join(parts)


def imported(text: str) -> set[str]:
    """Names of the package's top-level modules, and of its packages, that a module imports relative to itself.

    >>> sorted(imported("from .scene import Scene\\nfrom . import mesh\\nimport numpy"))
    ['mesh', 'scene']
    """
    found: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            found |= {node.module.split(".")[0]} if node.module else {alias.name for alias in node.names}
    return found


def summary(text: str) -> str:
    """First line of a module's docstring."""
    return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]


def levels(names: Mapping[str, str], edges: Sequence[tuple[str, str]]) -> dict[str, int]:
    """Level of each module: 0 imports none, n imports one of level n - 1."""

    @cache
    def level(name: str) -> int:
        return max((1 + level(start) for start, stop in edges if stop == name), default=0)

    return {name: level(name) for name in names}
