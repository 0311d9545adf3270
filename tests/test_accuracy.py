"""Errors of scores from a coarser solution."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.errors import ResultError
from fingerpad.prediction.edges import edge_intervals
from fingerpad.prediction.forecast import forecast
from fingerpad.prediction.scoring import ReadSolution, error_rows, prepared, read_out, rows_at, solve_scene
from fingerpad.readouts.accuracy import LEAST, read_cases, score_errors, true_errors, with_errors
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.roughness import SCORE_COLUMNS, roughness_scores, scene_span, unpredicted_rows, unscored_rows
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import Condition
from fingerpad.scene.readout import Readout
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import write_rows
from scenes import scene

GRID = np.linspace(-12.0, 12.0, 2401)  # mm
NEVER = 4.0  # times its stated error that no true one may be; source: the project's aim


def row(condition: str, score: float | str | None, interface: str = "shear", readout: str = "strain") -> dict[str, Any]:
    """A row of the score table."""
    return {
        "kinematics": "small",
        "device": "d",
        "condition": condition,
        "interface": interface,
        "readout": readout,
        "score": score,
        "unit": "mm2",
    }


def test_a_table_without_a_case_is_refused(tmp_path: Path) -> None:
    """Rows that are lost are no scores that nobody asked for."""
    own, path = scene("device2"), tmp_path / "score.csv"
    condition = own.device.conditions[0]
    rows = unscored_rows(own, condition, Interface.SHEAR, "")
    write_rows(path, rows)
    assert len(read_cases(path, own, [(condition.name, Interface.SHEAR)])) == len(rows)
    for left, case in ((rows[:1], "shear"), (rows[:0], "shear"), (rows, "frictionless"), (rows * 2, "shear")):
        write_rows(path, left)
        with pytest.raises(ResultError, match=r"score\.csv: is not what fingerpad writes there \(cases are missing"):
            read_cases(path, own, [(condition.name, case)])


def check(condition: str, error: float | str | None, note: str = "", readout: str = "strain") -> dict[str, Any]:
    """A row of the table of errors, also as text from a file."""
    case = {key: value for key, value in row(condition, None, readout=readout).items() if key not in {"score", "unit"}}
    return case | {"score_error": error, "note": note}


def curves(strain: FloatArray, change: FloatArray) -> FilteredReadouts:
    """Filtered read-outs (GRID.size,) with these values."""
    return FilteredReadouts(GRID, strain, change, strain, change)


def test_curves_that_differ_have_an_error_though_their_areas_agree() -> None:
    """One curve is the other's mirror image: scores are the same, and say nothing of how far the curves are apart."""
    slope = 1.0 + 0.01 * GRID
    found = score_errors(scene("device2"), curves(slope, slope), curves(slope[::-1], slope))
    start, stop = scene_span(scene("device2"))
    # |2 * 0.01 s| over a span that mirrors, for the order between the first and the second
    expected = 0.02 * stop**2 / (2.0**1.5 - 1.0)
    assert (start, found[Readout.STRAIN]) == (-stop, pytest.approx(expected, rel=1e-4))


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_an_error_is_the_difference_of_scores_where_curves_differ_one_way(factor: float) -> None:
    """Over that of sizes twice as large, to the power between first and second order, less one; to rounding."""
    base, strain, change = scene("device2"), 1.5 + np.sin(GRID), 0.2 + 0.1 * np.cos(GRID)
    fine, coarse = curves(strain, change), curves(factor * strain, factor * change)
    scores, others = (roughness_scores(base, each) for each in (fine, coarse))
    expected = {each: abs(others[each] - scores[each]) / (2.0**1.5 - 1.0) for each in Readout}
    assert score_errors(base, fine, coarse) == pytest.approx(expected, rel=1e-12)


def test_curves_that_agree_have_the_least_error_and_those_of_nothing_none() -> None:
    """A thousandth of the score, the median of errors against references (decision 25)."""
    base, one, zero = scene("device2"), np.ones(GRID.size), np.zeros(GRID.size)
    found = score_errors(base, curves(one, zero), curves(one, zero))
    start, stop = scene_span(base)
    assert found[Readout.STRAIN] == pytest.approx(1e-3 * (stop - start))
    assert found[Readout.CHANGE_OF_STRAIN] == 0.0


def test_curves_on_another_grid_are_compared_where_the_first_one_is() -> None:
    """The coarser mesh's receptors span almost the same arc, in other steps."""
    values = np.sin(GRID)
    other = np.linspace(GRID[0], GRID[-1], 3 * GRID.size)
    coarser = FilteredReadouts(other, *(np.sin(other),) * 4)
    found = score_errors(scene("device2"), curves(values, values), coarser)
    scores = roughness_scores(scene("device2"), curves(values, values))
    assert found == pytest.approx({each: LEAST * scores[each] for each in Readout})


@pytest.mark.parametrize("kinematics", Kinematics)
def test_errors_are_of_the_time_that_is_read(kinematics: Kinematics) -> None:
    """Sideways and back to the other side, without friction: a mirrored row has two peaks, which are mirror images, and
    a coarser mesh may find the other one larger. The error is that of going to the first peak alone.
    """
    base = scene("device2").coarsened(2.0).with_kinematics(kinematics)
    there = np.full((1, 4), 0.02)
    once = Condition("once", "a", 0.0, np.array([1.0]), 0.0 * there, there)
    path = np.concatenate([there, 0.0 * there, -there])
    both = Condition("both", "a", 1.0, np.array([1.0, 2.0, 3.0]), 0.0 * path, path)
    found = forecast(base.with_device(conditions=(once, both)))
    without = [row for row in found if row["interface"] == Interface.FRICTIONLESS]
    errors = {(row["condition"], row["readout"]): row["score_error"] for row in without}
    for readout in Readout:
        assert errors["both", readout] == pytest.approx(errors["once", readout], rel=0.01)


def test_errors_are_of_the_time_that_was_read_whatever_a_coarser_mesh_would_read() -> None:
    """A score that was read half-way has the error of going there alone, though strain goes on changing."""
    base = scene("device2").coarsened(2.0)
    path = np.outer([0.5, 1.0], 0.02 * np.array([1.0, -1.0, 1.0, -1.0]))
    whole = Condition("there", "a", 0.0, np.array([1.0, 2.0]), 0.0 * path, path)
    half, further = (base.with_conditions([each]) for each in (whole.until(0), whole))
    edges = edge_intervals(further)
    condensed = prepared(half, edges)
    (solved,) = solve_scene(half, condensed, [Interface.FRICTIONLESS])
    read = {solved.case: ReadSolution(solved.solution, read_out(half, condensed, solved.solution))}
    assert error_rows(further, edges, read) == error_rows(half, edges, read)


def test_a_coarser_solution_takes_fewer_increments() -> None:
    """So its error is that of the path, too; one is the least."""
    given = scene("device2").model.numerics
    for factor in (2.0, 1e3):
        coarser = given.coarsened(factor)
        assert coarser.stimulus_increments == max(given.stimulus_increments / factor, 1)
        assert coarser.indentation_increments == max(given.indentation_increments / factor, 1)


def test_errors_stand_behind_scores() -> None:
    (found,) = with_errors([row("a", "1.0")], [check("a", "0.02")])
    assert found["score_error"] == 0.02
    assert list(found) == ["kinematics", "device", "condition", "interface", "readout", "score", "score_error", "unit"]
    for each in with_errors(unpredicted_rows(scene("device3")), []):
        assert list(each) == SCORE_COLUMNS


def test_what_has_no_score_has_no_error() -> None:
    found = with_errors([row("a", "1.0"), row("a", None, "frictionless")], [check("a", "0.1")])
    assert [each["score_error"] for each in found] == [0.1, None]


def test_a_coarser_solution_that_cannot_be_had_leaves_errors_unknown() -> None:
    """The score stays, and the note says why."""
    lost = check("a", "", "error unknown: lost")
    scores = [row("a", "1.0") | {"note": "deep"}, row("b", "2.0") | {"note": ""}]
    first, second = with_errors(scores, [lost, check("b", "0.1")])
    assert (first["score"], first["score_error"], first["note"]) == ("1.0", None, "deep; error unknown: lost")
    assert second["score_error"] == pytest.approx(0.1)
    assert not true_errors([first], [row("a", "1.0") | {"times_unknowns": "20"}])


def test_true_errors_stand_beside_stated_ones() -> None:
    stated = row("a", "2.0") | {"score_error": "0.1"}
    (found,) = true_errors([stated, row("a", "", "frictionless")], [row("a", "1.9") | {"times_unknowns": "20.5"}])
    assert found["times_unknowns"] == 20.5
    assert found["stated"] == pytest.approx(0.05)
    assert found["error"] == pytest.approx(0.05)
    assert found["error_over_stated"] == pytest.approx(1.0)


def test_an_interface_without_a_reference_is_left_out() -> None:
    stated = [row("a", "2.0", interface) | {"score_error": "0.1"} for interface in ("shear", "frictionless")]
    (found,) = true_errors(stated, [row("a", "1.9") | {"times_unknowns": "20"}])
    assert found["interface"] == "shear"
    with pytest.raises(KeyError):
        true_errors([stated[0], row("b", "2.0") | {"score_error": "0.1"}], [row("a", "1.9") | {"times_unknowns": "20"}])


def test_a_missing_check_is_an_error() -> None:
    with pytest.raises(KeyError, match="'b'"):
        with_errors([row("b", "1.0")], [check("a", "0.1")])


def test_a_single_pin_that_moves_sideways_states_an_error_that_holds() -> None:
    """Its scores on the shipped mesh and on one of twice the sizes agree to some per cent by chance, while their curves
    do not: half the sizes move the score by a fifth (decision 32).
    """
    base = scene("device2")
    pin = replace(base.device.actuators, positions=(0.0,))
    moved = np.array([[0.02]])
    aside = Condition("aside", "one", 0.0, np.array([1.0]), 0.0 * moved, moved)
    single = base.with_device(actuators=pin, conditions=(aside,), cycles=())
    finer = [row | {"times_unknowns": "4"} for row in rows_at(single, 0.5, edge_intervals(single))]
    found = true_errors(forecast(single), finer)
    assert len(found) == 4
    assert max(row["error_over_stated"] for row in found) < NEVER
    assert max(abs(row["error"]) for row in found) > 0.03  # or it would prove nothing
