"""What an import leaves out: commands and jobs that check scene files start without what they never use."""

from __future__ import annotations

import sys
from importlib import import_module

import pytest

from fingerpad.imports import without


@pytest.mark.parametrize("module", ["colorsys", "json"], ids=["not loaded", "loaded"])
def test_a_module_that_was_left_out_is_found_later(module: str) -> None:
    before = sys.modules.get(module)
    with without(module), pytest.raises(ModuleNotFoundError, match=f"import of {module} halted"):
        import_module(module)
    assert sys.modules.get(module) is before
    assert import_module(module).__name__ == module
