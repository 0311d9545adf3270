"""A map of the code, made from it: modules with what they import, rules with what their scripts do."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Container, Mapping, Sequence
from pathlib import PurePosixPath

from ..digraph import levels, reduced
from ..markdown import table

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
PACKAGES = """\
## Packages

Imports point one way: a package, or a module that stands beside them, imports those of lower levels alone, and so does
a module within its package. What other imports imply is left out.
"""


def page(modules: Mapping[str, str], rules: Mapping[str, str], scripts: Mapping[str, str]) -> str:
    """Markdown page of the code. All arguments are texts: modules by path in the package, the others by stem.
    Raises CycleError (graphlib) if imports lead back to where they began.
    """
    texts = {dotted(path): text for path, text in modules.items()}
    texts.pop("", None)
    packages = sorted({dotted(path) for path in modules if "/" in path and path.endswith("__init__.py")})
    edges = {(other, name) for name, text in texts.items() for other in imported(text, name, texts)}
    outer = {(unit(other), unit(name)) for other, name in edges if unit(other) != unit(name)}
    shown = {name: f"`{name}/`" if name in packages else f"`{name}`" for name in map(unit, texts)}
    said = {name: summary(texts[name]) for name in shown}
    parts = [INTRODUCTION, PACKAGES, _ordered(("level", "package", "what", "imports"), shown, said, outer)]
    level = levels(outer, shown)
    for package in sorted(packages, key=lambda package: (level[package], package)):
        inside = {name for name in texts if unit(name) == package and name != package}
        parts.append(f"### `{package}/`\n\n{said[package]}\n")
        parts.append(
            _ordered(
                ("level", "module", "what", "imports of these"),
                {name: f"`{name.partition('.')[2]}`" for name in inside},
                {name: summary(texts[name]) for name in inside},
                {(other, name) for other, name in edges if {other, name} <= inside},
            )
        )
    parts.append("## Rules\n\nA rule without a script gathers targets or copies a file.\n")
    for stem, text in sorted(rules.items()):
        told = [(f"`{name}`", summary(scripts[name]) if name in scripts else "") for name in RULE.findall(text)]
        if told:
            parts.append(f"### `{stem}.smk`\n")
            parts.append(table(("rule", "its script"), told) + "\n")
    return "\n".join(parts)


def _ordered(
    heads: Sequence[str], shown: Mapping[str, str], said: Mapping[str, str], edges: Collection[tuple[str, str]]
) -> str:
    """Table of names from the lowest level up: how each is shown, what is said of it, and what it imports."""
    level = levels(edges, shown)
    imports: dict[str, list[str]] = {name: [] for name in shown}
    for other, name in reduced(edges):
        imports[name].append(shown[other])
    order = sorted(shown, key=lambda name: (level[name], name))
    return table(heads, [(level[name], shown[name], said[name], ", ".join(imports[name])) for name in order]) + "\n"


def dotted(path: str) -> str:
    """Name of a module, or of a package, within the library.

    >>> dotted("scene/device.py"), dotted("scene/__init__.py"), dotted("__init__.py")
    ('scene.device', 'scene', '')
    """
    return ".".join(part for part in PurePosixPath(path).with_suffix("").parts if part != "__init__")


def unit(name: str) -> str:
    """The package that a module is in, or the module itself where it is in none."""
    return name.partition(".")[0]


def imported(text: str, name: str, known: Container[str]) -> set[str]:
    """Those of the known modules that one of them, of this name, imports relative to itself.

    >>> text = "from ..scene.device import Device\\nfrom . import path\\nimport numpy"
    >>> sorted(imported(text, "contact.problem", {"scene.device", "contact.path"}))
    ['contact.path', 'scene.device']
    """
    found: set[str] = set()
    package = name.split(".")[:-1]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1] + ([node.module] if node.module else [])
            names = {".".join([*base, alias.name]) for alias in node.names} | {".".join(base)}
            found |= {name for name in names if name in known}
    return found


def summary(text: str) -> str:
    """First line of a module's docstring."""
    return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
