"""Forces that actuators have to bear."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from fingerpad.commands.forces import PRESSED, as_table
from fingerpad.contact.solution import Solution
from fingerpad.prediction import forces
from fingerpad.prediction.forces import DIFFERENCE, ERROR, NORMAL, TANGENTIAL, force_rows
from fingerpad.prediction.scoring import Solved
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.device import Condition
from fingerpad.scene.scene import Scene
from scenes import scene, solved

FINER = 0.5  # sizes and increments [1] of a reference
EQUAL = 1e-6  # relative; each half of a mirrored row is solved to a tolerance of 1e-9 of its largest force


@cache
def rows(device: str) -> Sequence[dict[str, Any]]:
    """Forces of a shipped device, with errors."""
    return force_rows(scene(device))


def chosen(
    found: Sequence[dict[str, Any]], column: str, condition: str, interface: Interface, read: bool
) -> np.ndarray:
    """One column of one condition at an interface, after pre-indentation or when it is read."""
    case = [
        row for row in found if (row["condition"], row["interface"], row["is_read"]) == (condition, interface, read)
    ]
    return np.array([row[column] for row in case])


@pytest.mark.parametrize("interface", list(Interface))
def test_actuators_bear_what_the_row_is_pressed_with(interface: Interface) -> None:
    """Mirrored actuators the same, and shear that cancels."""
    solution = solved("device2", "alternate_090", interface)
    normal, along = (
        chosen(rows("device2"), way, "alternate_090", interface, read=False) for way in (NORMAL, TANGENTIAL)
    )
    assert normal.sum() == pytest.approx(solution.force[0, :, 1].sum(), rel=EQUAL)
    assert normal == pytest.approx(normal[::-1], rel=EQUAL)
    assert along == pytest.approx(-along[::-1], rel=EQUAL)
    assert np.any(along != 0.0) == (interface is Interface.SHEAR)
    acting = chosen(rows("device2"), NORMAL, "alternate_090", interface, read=True)
    assert acting == pytest.approx(solution.pressing[1 + solution.reading.time], rel=EQUAL)


def test_skin_is_pushed_where_a_pin_goes() -> None:
    """Against pre-indentation, at 180 degrees: pins 1 and 3 to the right, 2 and 4 to the left."""
    change = [chosen(rows("device2"), TANGENTIAL, "alternate_180", Interface.SHEAR, read) for read in (True, False)]
    assert np.sign(change[0] - change[1]).tolist() == [1.0, -1.0, 1.0, -1.0]


@pytest.mark.parametrize("device", ["device1", "device2", "device3"])
def test_errors_are_honest(device: str) -> None:
    """Of every force, against a mesh of half the sizes and half as long increments."""
    given = scene(device)
    finer = force_rows(given.coarsened(FINER), error=False)
    for row, reference in zip(rows(device), finer, strict=True):
        for way in (NORMAL, TANGENTIAL):
            assert abs(row[way] - reference[way]) <= row[ERROR]


def test_an_error_is_what_coarser_forces_are_off_by(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over DIFFERENCE, as from two meshes of sizes 1 and 2; the largest of all actuators and directions."""
    given, solve, off = scene("device3"), forces.solve_scene, 0.02  # N/mm
    fine = list[Solved]()

    def shifted(shown: Scene, condensed: Any) -> Iterator[Solved]:
        if shown is given:
            for each in solve(shown, condensed):
                fine.append(each)
                yield each
            return
        for each in fine:
            assert isinstance(each.solution, Solution)
            force = each.solution.actuator_force.copy()
            force[:, 2, 0] -= off
            yield replace(each, solution=replace(each.solution, actuator_force=force))

    monkeypatch.setattr(forces, "solve_scene", shifted)
    found = force_rows(given)
    assert [row[ERROR] for row in found] == pytest.approx([off / DIFFERENCE] * len(found))


def test_every_time_of_a_history_has_its_forces() -> None:
    """Pre-indentation first; one of the others is read."""
    given = scene("device2")
    moves = np.array([[0.0, 0.0, 0.0, 0.0], [0.01, 0.0, 0.0, 0.0]])
    path = Condition("a", "a", 0.0, np.array([0.5, 2.0]), moves, 0.0 * moves)
    found = force_rows(given.with_conditions((path,)), error=False)
    shear = [row for row in found if row["interface"] == "shear"]
    assert [(row["time"], row["time_unit"], row["actuator"]) for row in shear] == [
        (t, "s", n) for t in (0.0, 0.5, 2.0) for n in (1, 2, 3, 4)
    ]
    assert [row["x_mm"] for row in shear[:4]] == list(given.device.actuators.positions)
    assert [row[NORMAL] for row in shear[:4]] == pytest.approx([row[NORMAL] for row in shear[4:8]], rel=EQUAL)
    assert shear[8][NORMAL] > shear[4][NORMAL]
    assert [row["is_read"] for row in shear] == [False] * 8 + [True] * 4
    assert {row[ERROR] for row in shear} == {None}


def test_forces_have_the_caveats_of_their_solution() -> None:
    """Those of scores, each once below the table."""
    given = scene("device2")
    given = given.with_conditions(given.device.conditions[:1]).coarsened(2.0)
    doubted = given.with_model(contact=replace(given.model.contact, friction=0.0))
    found = force_rows(doubted, error=False)
    told = "contact.friction is 0: the interface called shear has no friction here either"
    assert all((told in row["caveats"]) is (row["interface"] == "shear") for row in found)
    assert [line for line in as_table(doubted, found).splitlines() if told in line] == [
        f"caveat: alternate_000 (shear, forces): {told}"
    ]
    assert not any(row["caveats"] for row in force_rows(given, error=False))


def too_far(given: Scene) -> Scene:
    """The scene pressed deeper than the pad is thick."""
    contact = replace(given.model.contact, criterion=Criterion.DEPTH, depth=6.0)
    return given.with_model(contact=contact)


def test_what_cannot_be_solved_is_a_row_with_the_reason() -> None:
    found = force_rows(too_far(scene("device2")))
    assert len(found) == 2 * 3  # interfaces and conditions
    assert {row[NORMAL] for row in found} == {None}
    assert all("did not reach a depth of 6 mm" in row["note"] for row in found)


def test_forces_are_there_where_their_error_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    given, solve = scene("device2"), forces.solve_scene

    def without_coarser(shown: Scene, condensed: Any) -> Any:
        return solve(shown if shown is given else too_far(shown), condensed)

    monkeypatch.setattr(forces, "solve_scene", without_coarser)
    found = force_rows(given)
    assert all(row[NORMAL] is not None and row[ERROR] is None for row in found)
    assert all(row["note"].startswith("error unknown: on a mesh of 2 times the sizes, ") for row in found)


def test_the_table_has_pre_indentation_once_and_the_times_that_are_read() -> None:
    lines = as_table(scene("device3"), rows("device3")).splitlines()
    names = [line.split()[0] for line in lines[3:]]
    assert names == [name for name in (PRESSED, "alternate_000", "alternate_090", "alternate_180") for _ in range(4)]
    header, first = lines[2].split(), lines[3].split()
    assert len(header) == len(first)
    row = rows("device3")[0]
    assert float(first[header.index("normal")]) == pytest.approx(row[NORMAL], abs=row[ERROR])
