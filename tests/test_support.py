"""What the Snakefile takes from `workflow/support.py`: the code that a script reaches, and fingerprints of scenes."""

from __future__ import annotations

import ast
import dataclasses
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from fingerpad.scene.readout import GaborFilter
from fingerpad.scene.scene import Scene
from fingerpad.scene.scenefile import load_scene
from support import checksum, checksum_of_code, commit, files_in, fingerprint, reached_modules

ROOT = Path(__file__).parents[1]
CONFIG = ROOT / "config" / "config.yaml"
DEVICE = ROOT / "config" / "devices" / "device2.yaml"
FILES = {
    "script.py": "import numpy\nfrom fingerpad.top import thing\n",
    "src/fingerpad/__init__.py": "",
    "src/fingerpad/top.py": "from . import middle\nfrom .leaf import value\n",
    "src/fingerpad/middle.py": "import fingerpad.leaf\nimport fingerpad.top\n",
    "src/fingerpad/leaf.py": "def late():\n    from .late import never\n",
    "src/fingerpad/late.py": "import math\n",
    "src/fingerpad/unused.py": "from .top import thing\n",
    "src/fingerpad/drawing/__init__.py": "from ..leaf import value\n",
    "src/fingerpad/drawing/map.py": "from .style import line\nfrom ..late import never\n",
    "src/fingerpad/drawing/style.py": "",
    "src/fingerpad/drawing/unused.py": "",
}
REACHED_BY_MIDDLE = ["__init__", "middle", "leaf", "late", "top"]
PRINT_CHECKSUM = """
import sys
from pathlib import Path
from support import checksum_of_code
print(checksum_of_code(*map(Path, sys.argv[1:])))
"""
DRAWING = ["drawing/__init__", "drawing/map", "drawing/style", "leaf", "late"]


@pytest.fixture
def code(tmp_path: Path) -> Path:
    """A small package with a script that uses it."""
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


def reached(code: Path, script: str) -> list[str]:
    """The modules that a script of this text reaches, without the script and the package itself."""
    path = code / "script.py"
    path.write_text(script, encoding="utf-8")
    found = [Path(name) for name in reached_modules(path, code / "src")]
    assert path in found
    package = code / "src" / "fingerpad"
    names = [str(name.relative_to(package).with_suffix("")) for name in found if name != path]
    return [name for name in names if name != "__init__"]


def test_reaches_what_its_modules_reach_in_turn(code: Path) -> None:
    assert reached(code, FILES["script.py"]) == sorted(["top", "middle", "leaf", "late"])


def test_reaches_the_package_itself(code: Path) -> None:
    found = reached_modules(code / "script.py", code / "src")
    assert str(code / "src/fingerpad/__init__.py") in found


def test_reaches_nothing_without_the_package(code: Path) -> None:
    (code / "script.py").write_text("import numpy\nfrom fingerpadding import top\n", encoding="utf-8")
    assert reached_modules(code / "script.py", code / "src") == [str(code / "script.py")]


def test_reaches_what_the_code_of_a_notebook_reaches(code: Path) -> None:
    """Its code cells alone: text that reads like an import is none, nor are lines for IPython or the shell."""
    cells = [
        ("markdown", ["from fingerpad.late import never"]),
        ("code", ["%timeit -n 3 print\n", "if True:\n", "    !pwd\n"]),
        ("code", ["x = 1\n", "import fingerpad.middle"]),
    ]
    notebook = {"cells": [{"cell_type": kind, "source": source} for kind, source in cells]}
    path = code / "look.ipynb"
    path.write_text(json.dumps(notebook), encoding="utf-8")
    package = code / "src" / "fingerpad"
    found = reached_modules(path, code / "src")
    assert found == sorted(str(each) for each in (path, *(package / f"{name}.py" for name in REACHED_BY_MIDDLE)))


def test_is_sorted_and_without_repeats(code: Path) -> None:
    found = reached_modules(code / "script.py", code / "src")
    assert found == sorted(set(found))


@pytest.mark.parametrize(
    "script",
    [
        "from fingerpad.drawing import map",
        "from fingerpad.drawing.map import draw",
        "import fingerpad.drawing.map",
        "import fingerpad.drawing.map as drawn",
        "import sys, fingerpad.drawing.map",
        "from fingerpad.drawing import (  # map (of a section)\n    map as drawn,\n)",
        "from fingerpad.drawing \\\n    import map",
        "def main():\n    from fingerpad.drawing.map import draw\n",
    ],
)
def test_reaches_modules_of_a_package_and_the_package(code: Path, script: str) -> None:
    assert reached(code, script) == sorted(DRAWING)


def test_imports_are_those_that_python_sees() -> None:
    """What a search of the text finds in every program here is what a parser finds."""
    source = ROOT / "src"
    modules = {path.relative_to(source).with_suffix("").parts: str(path) for path in source.rglob("*.py")}
    for path in (*source.rglob("*.py"), *(ROOT / "workflow" / "scripts").glob("*.py")):
        package = path.parent.relative_to(source).parts if path.is_relative_to(source) else ()
        parsed = set[str]()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names = [tuple(alias.name.split(".")) for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                above = package[: len(package) - node.level + 1] if node.level else ()
                base = (*above, *(node.module.split(".") if node.module else ()))
                names = [base, *((*base, alias.name) for alias in node.names)]
            else:
                continue
            parsed |= {modules[name] for name in names if name in modules}
        reached = set(reached_modules(path, source))
        assert parsed <= reached, path
        # nothing more: what else is reached is a package's own module, or reached by one of these
        through = set[str]().union(*(reached_modules(Path(each), source) for each in parsed), {str(path)})
        assert {each for each in reached - through if not each.endswith("__init__.py")} == set(), path


def test_edited_code_has_another_checksum(code: Path) -> None:
    """In the next start of Snakemake, whichever of the modules that are reached it was; none of the others."""
    script, source = code / "script.py", code / "src"

    def checksum_now() -> str:
        command = [sys.executable, "-c", PRINT_CHECKSUM, str(script), str(source)]
        environment = os.environ | {"PYTHONPATH": str(ROOT / "workflow")}
        return subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout

    first = checksum_now()
    assert first.strip() == checksum_of_code(script, source)
    (source / "fingerpad" / "unused.py").write_text("from .top import other\n", encoding="utf-8")
    assert checksum_now() == first
    (source / "fingerpad" / "late.py").write_text("import cmath\n", encoding="utf-8")
    assert checksum_now() != first


def test_files_are_those_that_a_project_has(code: Path) -> None:
    """Not what Python and Jupyter leave beside them."""
    for folder in ("__pycache__", ".ipynb_checkpoints", "fingerpad.egg-info"):
        (code / "src" / folder).mkdir()
        (code / "src" / folder / "left").touch()
    (code / "other").touch()
    found = [path.relative_to(code).as_posix() for path in files_in([code / "src", code / "script.py"])]
    assert found == sorted(FILES)


def test_fingerprint_does_not_depend_on_the_order_of_keys() -> None:
    assert fingerprint({"a": 1.0, "b": 2.0}) == fingerprint({"b": 2.0, "a": 1.0})


def test_fingerprint_depends_on_the_order_of_parts_and_of_lists() -> None:
    assert fingerprint(1.0, 2.0) != fingerprint(2.0, 1.0)
    assert fingerprint(np.array([1.0, 2.0])) != fingerprint(np.array([2.0, 1.0]))


def test_fingerprint_tells_classes_of_the_same_values_apart() -> None:
    one, other = (dataclasses.make_dataclass(name, [("width", float)]) for name in ("Disc", "Square"))
    assert fingerprint(one(1.0)) != fingerprint(other(1.0))


def test_the_commit_of_a_checkout_says_whether_files_differ(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a checkout, or without git, there is none."""
    assert commit(tmp_path) == ""
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b.c"]
    (tmp_path / "file").write_text("one", encoding="utf-8")
    for command in (["init", "--quiet"], ["add", "file"], ["commit", "--quiet", "--message", "a"]):
        subprocess.run([*git, *command], check=True)
    head = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    assert commit(tmp_path) == head
    (tmp_path / "file").write_text("two", encoding="utf-8")
    assert commit(tmp_path) == f"{head}, with changes"
    monkeypatch.setenv("PATH", "")
    assert commit(tmp_path) == ""


@pytest.fixture
def scene() -> Scene:
    """Device 2 as it is in the scene files."""
    return load_scene(CONFIG, DEVICE)


def whole(scene: Scene) -> str:
    """The fingerprint of everything in a scene."""
    return fingerprint(scene.model, scene.device)


def test_fingerprint_holds_no_source_and_no_comment(scene: Scene, tmp_path: Path) -> None:
    config, device = tmp_path / "config.yaml", tmp_path / "device2.yaml"
    for path, copy in ((CONFIG, config), (DEVICE, device)):
        text, edits = re.subn(r'source: "[^"]*"', 'source: "assumption: another one"', path.read_text("utf-8"))
        assert edits > 3
        copy.write_text(f"# a remark\n{text}", encoding="utf-8")
    assert whole(load_scene(config, device)) == whole(scene)


def test_checksum_minds_what_files_say_not_where_or_when(tmp_path: Path) -> None:
    first, second = tmp_path / "first.py", tmp_path / "second.py"
    first.write_text("x = 1\n", encoding="utf-8")
    second.write_text("x = 2\n", encoding="utf-8")
    before = checksum([str(first), str(second)])
    moved = first.rename(tmp_path / "moved.py")
    moved.touch()
    assert checksum([str(moved), str(second)]) == before
    moved.write_text("x = 3\n", encoding="utf-8")
    assert checksum([str(moved), str(second)]) != before


@pytest.mark.parametrize("name", [field.name for field in dataclasses.fields(GaborFilter)])
def test_the_last_bit_of_a_number_matters(scene: Scene, name: str) -> None:
    gabor = scene.model.gabor
    changed = dataclasses.replace(gabor, **{name: np.nextafter(getattr(gabor, name), 0.0)})
    assert fingerprint(changed) != fingerprint(gabor)


def test_every_material_matters(scene: Scene) -> None:
    finger = scene.model.finger
    for i, layer in enumerate(finger.pad):
        softer = dataclasses.replace(layer, material=dataclasses.replace(layer.material, poisson=0.4))
        changed = dataclasses.replace(finger, pad=(*finger.pad[:i], softer, *finger.pad[i + 1 :]))
        assert fingerprint(changed) != fingerprint(finger), layer.name


def test_path_holds_no_names(scene: Scene) -> None:
    first = scene.device.conditions[0]
    renamed = dataclasses.replace(first, dispersion="other")
    assert fingerprint(renamed.prescribed) == fingerprint(first.prescribed)
    assert fingerprint(scene.device.conditions[-1].prescribed) != fingerprint(first.prescribed)
