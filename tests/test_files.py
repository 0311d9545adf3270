"""Files are whole or not there."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from fingerpad.errors import ResultError
from fingerpad.files import replacing, require_folder, write_text
from fingerpad.scene.numerics import Numerics
from fingerpad.store import load, read_rows, read_table, save, save_arrays, write_rows
from scenes import scene


def test_a_failed_write_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    write_text(path, "before")
    with pytest.raises(ZeroDivisionError), replacing(path) as part:
        part.write_text("half")
        raise ZeroDivisionError
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_two_who_write_one_file_leave_that_of_the_last(tmp_path: Path) -> None:
    """Whole, whoever begins first, and nothing else."""
    path = tmp_path / "table.csv"
    with replacing(path) as first, first.open("w") as slow:
        slow.write("one, ")
        with replacing(path) as second:
            second.write_text("another")
        assert path.read_text() == "another"
        slow.write("slowly")
    assert path.read_text() == "one, slowly"
    assert list(tmp_path.iterdir()) == [path]


def test_what_a_killed_writer_left_goes_away(tmp_path: Path) -> None:
    """With the next write, and nothing that another has given such a name."""
    path, foreign = tmp_path / "table.csv", tmp_path / "table.csv.mine.part"
    foreign.write_text("mine")
    writing = (
        "import time; from pathlib import Path; from fingerpad.files import replacing\n"
        f"with replacing(Path({str(path)!r})) as part:\n"
        "    part.write_text('half'); print('begun', flush=True); time.sleep(60)"
    )
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[1] / "src")}
    with subprocess.Popen([sys.executable, "-c", writing], stdout=subprocess.PIPE, env=environment) as writer:
        assert writer.stdout is not None
        assert writer.stdout.readline() == b"begun\n"
        writer.kill()
    assert len(list(tmp_path.iterdir())) == 2
    write_text(path, "whole")
    assert sorted(tmp_path.iterdir()) == [path, foreign]


def test_a_row_that_does_not_fit_leaves_no_table(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="b"):
        write_rows(tmp_path / "table.csv", [{"a": 1}, {"b": 2}])
    assert not list(tmp_path.iterdir())


def test_no_rows_are_an_empty_table(tmp_path: Path) -> None:
    write_rows(tmp_path / "table.csv", [])
    assert read_rows(tmp_path / "table.csv", "case") == []
    assert read_table(tmp_path / "table.csv").empty


def test_a_table_comes_back(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    write_rows(
        path, [{"case": "a", "note": 'two\nlines, "quoted"', "score": 0.5}, {"case": "b", "note": "", "score": 1}]
    )
    assert [row["note"] for row in read_rows(path, "case", "score")] == ['two\nlines, "quoted"', ""]
    assert read_table(path)["score"].tolist() == [0.5, 1.0]


def test_a_table_cut_short_is_refused(tmp_path: Path) -> None:
    """Wherever it is cut, but between rows: as after a power cut, or on a disk that is full."""
    path = tmp_path / "table.csv"
    write_rows(path, [{"case": "a", "note": "x, y", "score": 0.5}])
    whole = path.read_bytes()
    for size in range(len(whole)):
        path.write_bytes(whole[:size])
        for read in (read_rows, read_table):
            if whole[:size] == b"case,note,score\n":
                continue
            with pytest.raises(
                ResultError, match=r"table\.csv: is not what fingerpad writes there.*; remove it, and run"
            ):
                read(path)
    path.write_bytes(whole)
    with pytest.raises(ResultError, match="no column unit"):
        read_rows(path, "case", "unit")
    path.write_bytes(whole + b"b,z\n")
    with pytest.raises(ResultError):
        read_rows(path)


def test_an_archive_holds_no_pickles(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="allow_pickle"):
        save_arrays(tmp_path / "solution.npz", {"a": np.array([{}], dtype=object)})
    assert not list(tmp_path.iterdir())


def test_a_written_file_replaces_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    write_text(path, "one")
    write_text(path, "two µm")
    assert path.read_text(encoding="utf-8") == "two µm"


def test_a_folder_is_no_place_for_a_file(tmp_path: Path) -> None:
    """The message names it, and not the file that would have been renamed to it."""
    path = tmp_path / "table.csv"
    path.mkdir()
    with pytest.raises(IsADirectoryError, match="is a folder, so no file can be written there") as found:
        write_text(path, "text")
    assert found.value.filename == str(path)
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_in_which_nobody_may_write_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *given: False)  # whoever runs the tests may write anywhere
    with pytest.raises(PermissionError, match="in which you may not write") as found:
        require_folder(tmp_path / "table.csv")
    assert found.value.filename == str(tmp_path)


def test_what_is_no_file_is_not_replaced_by_one(tmp_path: Path) -> None:
    """A pipe, or a device of the machine."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    with pytest.raises(OSError, match="is no regular file"):
        write_text(path, "text")
    assert path.is_fifo()
    assert list(tmp_path.iterdir()) == [path]


def test_what_a_link_leads_to_is_written_and_the_link_stays(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    link, target = tmp_path / "table.csv", tmp_path / "there" / "table.csv"
    link.symlink_to(target)
    for text in ("one", "two"):
        write_text(link, text)
        assert link.is_symlink()
        assert target.read_text() == text


def test_numbers_come_back_as_they_were(tmp_path: Path) -> None:
    numerics = scene("device2").model.numerics
    save(tmp_path / "numerics.npz", numerics)
    assert load(tmp_path / "numerics.npz", Numerics) == numerics
