"""Jobs of the workflow: how they end."""

from __future__ import annotations

from pathlib import Path

import pytest

from fingerpad.errors import CriterionError
from fingerpad.jobs import plain_errors


def test_an_expected_error_is_its_message_alone(tmp_path: Path) -> None:
    """In the log and as what Python prints at its end, with status 1; nothing else is held back."""
    log = tmp_path / "solve.log"
    with pytest.raises(SystemExit, match=r"^fingerpad: too wide$"), plain_errors([str(log)]):
        raise CriterionError("too wide")
    assert log.read_text(encoding="utf-8") == "too wide\n"
    with pytest.raises(ZeroDivisionError), plain_errors([str(log)]):
        raise ZeroDivisionError
