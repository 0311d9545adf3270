"""The pages of docs/: links lead somewhere, names exist, and what is made from the project is what the project says."""

from __future__ import annotations

import ast
import importlib
import re
import tomllib
from dataclasses import fields
from pathlib import Path

import pytest
import yaml

from fingerpad import api, errors
from fingerpad.contact.certificate import Certificate
from fingerpad.contact.solution import Solution
from fingerpad.digraph import levels
from fingerpad.pages.codemap import dotted, imported, page, summary, unit
from fingerpad.perception.correlation import COLUMNS
from fingerpad.prediction import frictions, phases, ranking
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.scorings import response_rows
from scenes import scene

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "fingerpad"
RULES = sorted((ROOT / "workflow" / "rules").rglob("*.smk"))  # with those in rules/custom
SCRIPTS = sorted((ROOT / "workflow" / "scripts").glob("*.py"))
TEMPLATES = sorted((ROOT / "workflow" / "pages").glob("*.md"))
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")), ROOT / "data" / "README.md"]
MODEL = (ROOT / "docs" / "model.md").read_text(encoding="utf-8")
EQUATIONS, _, INDEX = MODEL.partition("## From a figure to its equation")
MODULES = {path.relative_to(PACKAGE).as_posix(): path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py")}


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_links_within_the_project_lead_to_files(path: Path) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", path.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (path.parent / target.partition("#")[0]).exists(), target


def names_in(text: str) -> list[str]:
    """Names such as `module.function` in a page, whose first part is a module or a package of the library."""
    known = {path.split("/")[0].removesuffix(".py") for path in MODULES}
    found = re.findall(r"`([a-z_]+(?:\.(?!csv|npz)[A-Za-z_]+)+)`", text)
    return sorted({name for name in found if name.split(".")[0] in known and not is_key(name)})


def docstrings(tree: ast.Module) -> list[str]:
    """Of a module and all that is defined in it."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    return [ast.get_docstring(node, clean=False) or "" for node in ast.walk(tree) if isinstance(node, documented)]


def words_of(tree: ast.Module) -> set[str]:
    """Identifiers and texts in code, docstrings apart."""
    found: set[str] = set()
    told = set(docstrings(tree))
    for node in ast.walk(tree):
        for field in ("id", "attr", "arg", "name", "module", "value"):
            word = getattr(node, field, None)
            if isinstance(word, str) and word not in told:
                found.update(re.findall(r"\w+", word))
    return found


def test_every_name_in_a_docstring_exists() -> None:
    trees = {path: ast.parse(text) for path, text in MODULES.items()}
    known = {part for path in MODULES for part in path.removesuffix(".py").split("/")}
    known.update(*map(words_of, trees.values()))
    astray = {
        (path, name)
        for path, tree in trees.items()
        for text in docstrings(tree)
        for name in re.findall(r"`([a-z_][\w.]*)`", text)
        if name.rpartition(".")[2] not in known
    }
    assert not astray


def is_key(name: str) -> bool:
    """Whether a dotted name is a key of config.yaml: `contact.criterion`, say, beside the module `contact`."""
    section, _, key = name.partition(".")
    text = (ROOT / "config" / "config.yaml").read_text(encoding="utf-8")
    block = re.search(rf"^{section}:.*\n((?:[ #].*\n|\n)*)", text, re.MULTILINE)
    return bool(block and re.search(rf"^  {key}:", block[1], re.MULTILINE))


@pytest.mark.parametrize("name", names_in(MODEL))
def test_every_function_that_the_model_names_exists(name: str) -> None:
    parts = name.split(".")
    for depth in range(len(parts), 0, -1):
        path = PACKAGE.joinpath(*parts[:depth])
        if path.with_suffix(".py").is_file() or path.is_dir():
            found: object = importlib.import_module(".".join(["fingerpad", *parts[:depth]]))
            for attribute in parts[depth:]:
                assert hasattr(found, attribute), name
                found = getattr(found, attribute)
            return


def test_the_model_names_enough_to_be_checked() -> None:
    assert len(names_in(MODEL)) > 30


def test_every_constant_and_error_that_the_model_names_exists() -> None:
    text = "\n".join(MODULES.values())
    for name in re.findall(r"`([A-Z][A-Z_]{4,})`", MODEL):
        assert re.search(rf"^{name}\b", text, re.MULTILINE), name
    assert set(re.findall(r"`(\w+Error)`", MODEL)) <= {name for name in vars(errors) if name.endswith("Error")}


def test_every_figure_of_all_leads_to_an_equation() -> None:
    rules = "".join(path.read_text(encoding="utf-8") for path in RULES)
    stems = set(re.findall(r"results/figures/(\w+?)(?:\{mode\})?\.png", rules)) - {"benchmark", "rules"}
    assert len(stems) > 5
    for stem in stems:
        assert f"`{stem}`" in INDEX
    for name in re.findall(r"`(figure_[a-z]+)`", INDEX):
        assert re.search(rf"rule {name}:", rules), name


def test_equations_are_numbered_in_order() -> None:
    found = re.findall(r"\\tag\{(\d+)\}|\| \((\d+)\) \|$", EQUATIONS, re.MULTILINE)
    numbers = [int(displayed or tabled) for displayed, tabled in found]
    assert numbers == list(range(1, len(numbers) + 1))
    assert {int(number) for number in re.findall(r"\((\d+)\)", INDEX)} <= set(numbers)


def test_committed_map_is_what_the_code_says() -> None:
    made = page(
        MODULES,
        {path.stem: path.read_text(encoding="utf-8") for path in RULES},
        {path.stem: path.read_text(encoding="utf-8") for path in SCRIPTS},
    )
    committed = (ROOT / "docs" / "map.md").read_text(encoding="utf-8")
    assert committed == made, "the code has changed: run `snakemake docs` and commit docs/map.md"


@pytest.mark.parametrize("template", TEMPLATES, ids=lambda path: path.stem)
def test_committed_page_says_what_its_template_says(template: Path) -> None:
    """Whatever its numbers, which take hours."""
    parts = re.split(r"\$\{\w+\}", template.read_text(encoding="utf-8"))
    pattern = ".*?".join(map(re.escape, parts))
    committed = (ROOT / "docs" / template.name).read_text(encoding="utf-8")
    assert re.fullmatch(pattern, committed, re.DOTALL), f"renew docs/{template.name}: `snakemake pages` or `docs`"


def test_imports_have_no_circle_and_levels_rise() -> None:
    """Neither between modules nor between packages; and imports are seen: there are more than modules."""
    texts = {dotted(path): text for path, text in MODULES.items()}
    modules = {(other, name) for name, text in texts.items() for other in imported(text, name, texts)}
    packages = {(unit(other), unit(name)) for other, name in modules if unit(other) != unit(name)}
    assert len(modules) > len(texts)
    for names, edges in ((texts, modules), (map(unit, texts), packages)):
        level = levels(edges, names)
        assert all(level[start] < level[stop] for start, stop in edges)


def test_citation_has_the_version_of_the_project() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == project["version"]
    assert citation["license"] == project["license"]


@pytest.mark.parametrize("path", sorted(MODULES))
def test_every_module_says_in_a_line_what_it_is(path: str) -> None:
    assert summary(MODULES[path]).endswith((".", ":"))


def test_the_page_of_outputs_names_what_is_written() -> None:
    """All arrays of what is solved and filtered, all columns of `predict` and of tables that `all` does not make."""
    named = set(re.findall(r"`([\w/]+)`", (ROOT / "docs" / "outputs.md").read_text(encoding="utf-8")))
    arrays = {field.name for kind in (Solution, FilteredReadouts) for field in fields(kind)}
    arrays = arrays - {"reading", "certificate"} | {f"certificate/{field.name}" for field in fields(Certificate)}
    columns = {*COLUMNS, *phases.COLUMNS, *frictions.COLUMNS, *api.PREDICTED, *api.FORCES, *ranking.RANKS}
    assert arrays | columns | set(response_rows(scene("device2"))[0]) <= named
