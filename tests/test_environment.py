"""`pyproject.toml`, `requirements.lock` and `environment.yml` describe one environment, and this is it."""

from __future__ import annotations

import importlib
import importlib.metadata
import re
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CONDA = yaml.safe_load((ROOT / "environment.yml").read_text(encoding="utf-8"))
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")

CONDA_NAMES = {"snakemake-minimal": "snakemake"}  # without what only clusters and the cloud need
# where the module is not named like the package
MODULES = {"ipython": "IPython", "pillow": "PIL", "pyyaml": "yaml", "scikit-fem": "skfem"}
NEEDED = [Requirement(text) for text in PROJECT["dependencies"]]
OPTIONAL = [Requirement(text) for extra in PROJECT["optional-dependencies"].values() for text in extra]


def named(requirement: Requirement) -> str:
    """A package's name as pip compares it."""
    return str(canonicalize_name(requirement.name))


def bounds(requirements: list[Requirement]) -> dict[str, SpecifierSet]:
    """What versions of what packages are allowed."""
    return {named(requirement): requirement.specifier for requirement in requirements}


def locked() -> list[tuple[Requirement, list[str]]]:
    """Every requirement of the lock with its hashes."""
    text = re.sub(r"^\s*#.*\n", "", LOCK.replace("\\\n", " "), flags=re.MULTILINE)
    parts = [line.split("--hash=") for line in text.splitlines() if line.strip()]
    return [(Requirement(first), [value.strip() for value in hashes]) for first, *hashes in parts]


def test_conda_has_the_packages_and_bounds_of_the_project() -> None:
    conda = bounds([Requirement(text) for text in CONDA["dependencies"]])
    python = conda.pop("python")
    assert {CONDA_NAMES.get(name, name): bound for name, bound in conda.items()} == bounds(NEEDED)
    assert python == SpecifierSet(PROJECT["requires-python"])


def test_conda_takes_packages_from_the_free_channels_only() -> None:
    assert CONDA["name"] == PROJECT["name"]
    assert CONDA["channels"] == ["conda-forge", "bioconda", "nodefaults"]


def test_every_package_has_a_lower_bound() -> None:
    for name, bound in bounds(NEEDED).items():
        assert any(part.operator == ">=" for part in bound), name


@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13"])
@pytest.mark.parametrize("needed", [*NEEDED, *OPTIONAL], ids=named)
def test_one_locked_version_satisfies_the_bound(needed: Requirement, python: str) -> None:
    environment = {"python_version": python, "python_full_version": f"{python}.0"}
    found = [
        entry
        for entry, _ in locked()
        if named(entry) == named(needed) and (entry.marker is None or entry.marker.evaluate(environment))
    ]
    assert len(found) == 1, f"{named(needed)} for Python {python}: {found}"
    (pin,) = found[0].specifier
    assert pin.operator == "=="
    assert needed.specifier.contains(pin.version), f"{found[0]} is locked, {needed} is needed"


def test_every_locked_requirement_is_pinned_and_has_a_hash() -> None:
    assert len(locked()) > len(NEEDED)
    for entry, hashes in locked():
        assert [part.operator for part in entry.specifier] == ["=="], entry
        assert hashes, f"{entry} has no hash"
        assert all(re.fullmatch("sha256:[0-9a-f]{64}", value) for value in hashes), entry


def test_lock_holds_no_address_and_no_option() -> None:
    assert "://" not in LOCK
    assert all(entry.url is None for entry, _ in locked())
    assert not re.search(r"^\s*-(?!-hash=sha256:)", LOCK, re.MULTILINE)


@pytest.mark.parametrize("needed", NEEDED, ids=named)
def test_package_is_here_in_an_allowed_version(needed: Requirement) -> None:
    importlib.import_module(MODULES.get(named(needed), named(needed)))
    assert needed.specifier.contains(importlib.metadata.version(needed.name))
