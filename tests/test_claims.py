"""Claims follow the numbers: each is made to hold, and each is broken."""

import io
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fingerpad.perception.claims import COLUMNS, claims_table
from fingerpad.perception.correlation import correlation_table
from fingerpad.readouts.comparison import Relation, Score, classes, relation
from fingerpad.readouts.roughness import SCORE_COLUMNS
from literature import CONDITIONS, LITERATURE

ROOT = Path(__file__).parents[1]
ERROR = 1e-3  # of every score: far below what tells them apart
NOTHING = [math.nan] * 3
AS_IN_THE_PAPER: dict[tuple[str, str, str], list[float]] = {
    ("device1", "shear", "strain"): [5, 4, 6, 5, 3, 4, 5, 6, 5],
    ("device1", "shear", "change_of_strain"): [1, 2, 3, 1, 3, 4, 1, 4, 5],
    ("device1", "frictionless", "strain"): [5, 4, 6, 5, 3, 4, 5, 6, 5],
    ("device1", "frictionless", "change_of_strain"): [1, 2, 3, 1, 3, 4, 1, 4, 5.5],
    ("device2", "shear", "strain"): [1, 2, 3],
    ("device2", "shear", "change_of_strain"): [1, 2, 3],
    ("device2", "frictionless", "strain"): [3, 2, 1],
    ("device2", "frictionless", "change_of_strain"): [0.5, 0.8, 0.6],
    ("device3", "shear", "strain"): [2, 1, 3],
    ("device3", "shear", "change_of_strain"): [2, 3, 1],
    ("device3", "frictionless", "strain"): NOTHING,
    ("device3", "frictionless", "change_of_strain"): NOTHING,
}


def make_scores(change: dict[tuple[str, str, str], list[float]] | None = None) -> pd.DataFrame:
    rows = []
    for (device, interface, readout), values in (AS_IN_THE_PAPER | (change or {})).items():
        for name, value in zip(CONDITIONS[device], values, strict=True):
            dispersion, phase = name.split("_")
            note = "no prediction" if math.isnan(value) else ""
            key = ("small", device, name, dispersion, float(phase), interface, readout)
            rows.append((*key, float(value), ERROR, "mm", note))
    return pd.DataFrame(rows, columns=SCORE_COLUMNS)


def correlate(scores: pd.DataFrame, kind: str = "measured") -> pd.DataFrame:
    """Correlations with the ratings in data/, taken for measured ones unless told otherwise."""
    return correlation_table(scores, replace(LITERATURE, ratings=LITERATURE.ratings.assign(kind=kind)))


def claims_of(change: dict[tuple[str, str, str], list[float]] | None = None) -> pd.DataFrame:
    scores = make_scores(change)
    return claims_table(scores, correlate(scores))


def test_all_claims_hold_for_scores_that_are_as_the_paper_says() -> None:
    table = claims_of()
    assert list(table.columns) == COLUMNS
    assert table["kind"].value_counts().to_dict() == {"stated": 17, "weaker": 4}
    assert table["claim"].is_unique
    assert (table["holds"] == "yes").all(), table.loc[table["holds"] != "yes", ["claim", "evidence"]].to_string()
    assert table["source"].str.startswith("paper").all()


@pytest.mark.parametrize(
    ("key", "values", "broken"),
    [
        (("device2", "shear", "change_of_strain"), [1, 3, 2], {"Device 2: the change of strain "}),
        (("device2", "shear", "change_of_strain"), [1, 2, 2 + 1e-12], {"Device 2: the change of strain "}),
        (
            ("device2", "shear", "change_of_strain"),
            [2, 4, 2],
            {"Device 2: the change of strain ", "Device 2 without shear: the change of strain correlates more weakly"},
        ),
        (("device3", "shear", "change_of_strain"), [1, 2, 3], {"Device 3: the change of strain "}),
        (
            ("device1", "shear", "change_of_strain"),
            [1, 2, 3, 1, 3.6, 3.5, 1, 4, 6],
            {"Device 1: the change of strain rises with phase", "Device 1: leaving out shear reverses"},
        ),
        (
            ("device1", "shear", "change_of_strain"),
            [1, 2, 4.1, 1, 3, 4, 1, 4.5, 6],
            {"Device 1: the change of strain rises with dispersion", "Device 1: leaving out shear reverses"},
        ),
        (("device1", "shear", "strain"), [1, 2, 3, 1, 3, 4, 1, 4, 5], {"Device 1: the strain "}),
        (
            ("device1", "shear", "strain"),
            [5, 4, 6, 5, 3, 2, 5, 6, 1],
            {"Device 1: the strain correlates very poorly"},
        ),
        (("device2", "shear", "strain"), [3, 2, 1], {"Device 2: the strain correlates"}),
        (("device2", "shear", "strain"), [1, 3, 1.5], {"Device 2: the strain correlates"}),
        (("device3", "shear", "strain"), [2, 3, 1], {"Device 3: the strain correlates"}),
        (("device3", "shear", "strain"), [2, 2, 2], {"Device 3: the strain correlates"}),
        (("device2", "frictionless", "strain"), [1, 2, 3], {"Device 2 without shear: the strain correlates"}),
        (
            ("device2", "frictionless", "change_of_strain"),
            [1, 2.2, 3.2],
            {
                "Device 2 without shear: the change of strain misses",
                "Device 2 without shear: the change of strain correlates weakly",
                "Device 2 without shear: the change of strain is smaller",
                "Device 2 without shear: the change of strain varies",
            },
        ),
        (
            ("device2", "frictionless", "change_of_strain"),
            [0.8, 0.4, 0.5],
            {"Device 2 without shear: the change of strain correlates weakly"},
        ),
        (
            ("device2", "frictionless", "change_of_strain"),
            [5, 9, 4.5],
            {
                "Device 2 without shear: the change of strain is smaller",
                "Device 2 without shear: the change of strain varies",
            },
        ),
        (
            ("device2", "frictionless", "change_of_strain"),
            [1.5, 1.8, 1.6],
            {"Device 2 without shear: the change of strain is smaller"},
        ),
        (
            ("device1", "frictionless", "change_of_strain"),
            [10, 20, 30, 10, 30, 40, 10, 40, 50],
            {"Device 1: leaving out shear matters"},
        ),
        (
            ("device1", "frictionless", "change_of_strain"),
            [1, 2, 3, 1, 3.3, 3.2, 1, 4, 6],
            {"Device 1: leaving out shear reverses"},
        ),
    ],
)
def test_each_claim_can_be_broken_and_no_other_breaks_with_it(
    key: tuple[str, str, str], values: list[float], broken: set[str]
) -> None:
    table = claims_of({key: values})
    failed = list(table.loc[table["holds"] == "no", "claim"])
    assert set(failed) == {claim for claim in table["claim"] if claim.startswith(tuple(broken))}
    assert not (table["holds"] == "undecided").any()


@pytest.mark.parametrize(
    ("key", "values", "open_"),
    [
        *(
            (
                ("device1", "shear", "change_of_strain"),
                [1, 2, 3, 1, 3.5, 3.5 + step, 1, 4, 6],
                ("Device 1: the change of strain rises with phase", "Device 1: leaving out shear reverses"),
            )
            for step in (0.0009, -0.0009)
        ),
        (("device3", "shear", "strain"), [2.0005, 2, 2.0011], "Device 3: the strain correlates"),
        (("device3", "shear", "strain"), [2.0005, 2.0011, 2], "Device 3: the strain correlates"),
        (
            ("device2", "frictionless", "change_of_strain"),
            [0.5002, 0.5004, 0.5],
            (
                "Device 2 without shear: the change of strain correlates",
                "Device 2 without shear: the change of strain misses",
            ),
        ),
        (
            ("device2", "frictionless", "change_of_strain"),
            [0.9999, 1.3, 1.1],
            "Device 2 without shear: the change of strain is smaller",
        ),
        (
            ("device2", "shear", "change_of_strain"),
            [1, 1.15, 1.3005],
            "Device 2 without shear: the change of strain varies",
        ),
        (
            ("device1", "frictionless", "change_of_strain"),
            [1, 2, 3, 1, 3, 3.0004, 1, 4, 5],
            "Device 1: leaving out shear reverses",
        ),
        (
            ("device1", "frictionless", "change_of_strain"),
            [1.6813 * score for score in (1, 2, 3, 1, 3, 4, 1, 4, 5)],
            "Device 1: leaving out shear matters",
        ),
    ],
)
def test_what_differs_by_less_than_its_error_decides_nothing(
    key: tuple[str, str, str], values: list[float], open_: str | tuple[str, ...]
) -> None:
    table = claims_of({key: values})
    undecided = table[table["holds"] == "undecided"]
    assert set(undecided["claim"]) == {claim for claim in table["claim"] if claim.startswith(open_)}
    assert (table.drop(undecided.index)["holds"] == "yes").all()


def test_unknown_errors_leave_all_open() -> None:
    scores = make_scores().assign(score_error=math.nan)
    assert (claims_table(scores, correlate(scores))["holds"] == "undecided").all()


def evidence_of(table: pd.DataFrame, start: str) -> str:
    return str(table.loc[table["claim"].str.startswith(start), "evidence"].item())


def test_evidence_shows_the_numbers_as_they_are() -> None:
    table = claims_of({("device2", "shear", "change_of_strain"): [1.25, 3, 2]})
    assert evidence_of(table, "Device 2: the change of strain rises") == "Scores [mm]: 0°: 1.25 < 90°: 3 > 180°: 2."
    assert evidence_of(table, "Device 3: the change of strain rises") == "Scores [mm]: 180°: 1 < 0°: 2 < 90°: 3."
    assert "1.75 with it" in evidence_of(table, "Device 2 without shear: the change of strain varies")


def test_evidence_from_ratings_says_ordinal_surrogate() -> None:
    scores = make_scores()
    table = claims_table(scores, correlate(scores, "surrogate"))
    for start in (
        "Device 3: the strain",
        "Device 2 without shear: the strain",
        "Device 2 without shear: the change of strain corr",
    ):
        evidence = table.loc[table["claim"].str.startswith(start), "evidence"].iloc[0]
        assert "ordinal surrogate" in evidence
        assert "R²" in evidence
    assert "negative slope, R² 1," in evidence_of(table, "Device 3: the strain")
    assert "R² 0.75 to 1 over all ratings with the stated order" in evidence_of(table, "Device 3: the strain")


@pytest.mark.parametrize(
    ("key", "values", "claim", "holds"),
    [
        # r of equal steps is 0.87 at least with any ratings that rise: enough for well, not for very well
        (("device2", "shear", "strain"), [1, 2, 3], "Device 2: the strain correlates well", "yes"),
        (
            ("device2", "shear", "change_of_strain"),
            [1, 2, 3],
            "Device 2: the change of strain correlates very",
            "undecided",
        ),
        (
            ("device2", "shear", "change_of_strain"),  # between 0.5 and 1, where without shear it is up to 0.76
            [1, 2, 2.1],
            "Device 2 without shear: the change of strain correlates more weakly",
            "undecided",
        ),
        (("device2", "shear", "strain"), [3, 2, 1], "Device 2: the strain correlates well", "no"),
        # 0.33 with ratings in equal steps, but between -0.19 and 0.76 with others
        (
            ("device2", "frictionless", "change_of_strain"),
            [0.5, 0.8, 0.6],
            "Device 2 without shear: the change of strain correlates weakly",
            "undecided",
        ),
        (("device2", "frictionless", "strain"), [3, 1, 2.9], "Device 2 without shear: the strain", "undecided"),
    ],
)
def test_surrogates_decide_what_all_ratings_with_their_order_do(
    key: tuple[str, str, str], values: list[float], claim: str, holds: str
) -> None:
    scores = make_scores({key: values})
    table = claims_table(scores, correlate(scores, "surrogate"))
    assert table.loc[table["claim"].str.startswith(claim), "holds"].item() == holds


def test_surrogates_without_an_order_decide_no_correlation() -> None:
    scores = make_scores()
    without = correlate(scores, "surrogate").assign(r2_lowest=math.nan, r2_highest=math.nan)
    table = claims_table(scores, without)
    correlating = table["claim"].str.contains("correlates")
    assert (table.loc[correlating, "holds"] == "undecided").all()
    assert (table.loc[~correlating, "holds"] == "yes").all()


def test_a_constant_score_is_evidence_without_a_slope() -> None:
    table = claims_of({("device2", "frictionless", "change_of_strain"): [1, 1, 1]})
    start = "Device 2 without shear: the change of strain correlates weakly"
    assert "no slope (constant score)" in evidence_of(table, start)
    assert table.loc[table["claim"].str.startswith(start), "holds"].item() == "yes"


@pytest.mark.parametrize(
    ("drop", "left"),
    [
        (lambda scores: scores["device"] == "device1", 12),
        (lambda scores: scores["device"] == "device2", 11),
        (lambda scores: scores["device"] == "device3", 18),
        (lambda scores: scores["interface"] == "frictionless", 11),
        (lambda scores: scores["device"].str.startswith("device"), 0),
    ],
)
def test_a_claim_about_scores_that_are_not_there_has_no_row(
    drop: Callable[[pd.DataFrame], "pd.Series[bool]"], left: int
) -> None:
    scores = make_scores()
    kept = scores[~drop(scores)]
    assert len(claims_table(kept, correlate(kept))) == left


@pytest.mark.parametrize("value", [math.nan, None])
def test_one_score_that_is_not_there_is_enough_for_no_row(value: float | None) -> None:
    """Whether its row says NaN or is missing, nothing is held or refuted without it."""
    scores = make_scores()
    correlations = correlate(scores)
    one = (scores["device"] == "device1") & (scores["condition"] == "medium_180") & (scores["interface"] == "shear")
    changed = scores[~one] if value is None else scores.assign(score=scores["score"].mask(one, value))
    table = claims_table(changed, correlations)
    assert len(table) == 16
    of_device1 = table.loc[table["claim"].str.startswith("Device 1"), "claim"]
    assert of_device1.str.contains("correlates").all()  # the table of correlations is still there


def test_a_strong_negative_correlation_is_no_weaker_than_a_positive_one() -> None:
    """Weak is what is said of |r|, whichever way the slope is."""
    table = claims_of(
        {
            ("device2", "frictionless", "change_of_strain"): [2, 1.5, 1],
            ("device2", "shear", "change_of_strain"): [1, 2, 4],
        }
    )
    start = "Device 2 without shear: the change of strain correlates more weakly"
    assert "without shear: negative slope, R² 1," in evidence_of(table, start)
    assert table.loc[table["claim"].str.startswith(start), "holds"].item() == "no"


@pytest.mark.parametrize(
    ("claim", "bound", "below", "above"),
    [
        *((f"Device {number}: the change of strain correlates very well", 0.936, "no", "yes") for number in (1, 2, 3)),
        ("Device 1 without shear: the change of strain still correlates very well", 0.936, "no", "yes"),
        ("Device 2: the strain correlates well", 0.6, "no", "yes"),
        ("Device 2 without shear: the change of strain correlates weakly", 0.4, "yes", "no"),
        ("Device 1: the strain correlates very poorly", 0.2, "yes", "no"),
    ],
)
def test_words_for_correlations_have_their_usual_bounds(claim: str, bound: float, below: str, above: str) -> None:
    """Those of Evans 1996, very well as the paper has it (R² 0.876). |r| is on either side by twice its error."""
    scores = make_scores()
    for r, holds in ((bound - 0.02, below), (bound + 0.02, above)):
        correlations = correlate(scores).assign(r2=r**2, slope_sign=1, r_error=0.01, slope_open=0)
        table = claims_table(scores, correlations)
        assert table.loc[table["claim"].str.startswith(claim), "holds"].item() == holds


@pytest.mark.parametrize(("apart", "holds"), [(0.015, "undecided"), (0.025, "yes")])
def test_correlations_compare_by_the_sum_of_their_errors(apart: float, holds: str) -> None:
    """Each may be off by 0.01."""
    scores = make_scores()
    correlations = correlate(scores).assign(slope_sign=1, r_error=0.01, slope_open=0)
    r = 0.5 + apart * (correlations["interface"] == "shear")
    table = claims_table(scores, correlations.assign(r2=r**2))
    start = "Device 2 without shear: the change of strain correlates more weakly"
    assert table.loc[table["claim"].str.startswith(start), "holds"].item() == holds


def test_scores_compare_by_the_sum_of_their_errors() -> None:
    """Each may be off by its own error, so that two may be closer than they seem by both."""
    low, high = Score(1.0, 0.1), Score(1.19, 0.1)
    assert relation(low, high) is Relation.NEAR
    assert relation(low, Score(1.21, 0.1)) is Relation.LESS


@pytest.mark.parametrize(("low", "high"), [(4e-7, 9e-7), (1.0, 1.0 + 2e-6), (1.0, 1.0 + 5e-7), (-1.0, -1.0 + 5e-7)])
def test_scores_that_share_a_place_are_the_same(low: float, high: float) -> None:
    """Beside a far larger one, too."""
    same = relation(Score(low, 0.0), Score(high, 0.0)) is Relation.SAME
    first, second, _ = classes(np.array([low, high, 1e3]))
    assert bool(first == second) is same


def test_a_claim_about_ratings_that_are_not_there_has_no_row() -> None:
    scores = make_scores()
    correlations = correlate(scores)
    without = claims_table(scores, correlations.assign(n=0, note="no ratings"))
    assert not without["claim"].str.contains("correlates").any()
    assert len(without) == 10


@pytest.mark.parametrize("note", ["fewer than three conditions", "constant rating"])
def test_a_claim_about_a_correlation_that_is_not_there_has_no_row(note: str) -> None:
    """Unlike one of a constant score, with which nothing correlates."""
    scores = make_scores()
    without = claims_table(scores, correlate(scores).assign(r2=math.nan, slope_sign=pd.NA, note=note))
    assert not without["claim"].str.contains("correlates").any()


def test_an_order_that_leaves_the_slope_open_decides_no_correlation() -> None:
    """Two classes of ratings without an order: |r| is 0.999 whichever is rated higher."""
    scores = make_scores({("device2", "shear", "change_of_strain"): [1.0, 1.1, 3.0]})
    correlations = correlate(scores, "surrogate")
    both = {"r_lowest": -0.9988, "r_highest": 0.9988, "r2_lowest": 0.9976, "r2_highest": 0.9976}
    table = claims_table(scores, correlations.assign(**both, range_error=0.01, range_open=0))
    claim = "Device 2: the change of strain correlates very well."
    assert table.loc[table["claim"] == claim, "holds"].item() == "undecided"


def test_a_sign_is_certain_where_errors_do_not_turn_it_however_large_they_are() -> None:
    """They may raise |r| by more than itself."""
    scores = make_scores({("device2", "frictionless", "strain"): [2.0, 1.5, 1.0]})
    correlations = correlate(scores).assign(r_error=2.0)
    claim = "Device 2 without shear: the strain correlates negatively."
    for is_open, holds in ((0, "yes"), (1, "undecided")):
        table = claims_table(scores, correlations.assign(slope_open=is_open))
        assert table.loc[table["claim"] == claim, "holds"].item() == holds


def test_committed_page_says_what_the_recorded_scores_do() -> None:
    recorded = pd.read_csv(ROOT / "tests" / "expected" / "scores.csv")
    small, finite = (
        claims_table(scores, correlate(scores, "surrogate"))
        for scores in (recorded[recorded["kinematics"] == each] for each in ("small", "finite"))
    )
    page = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")
    for claim, kind, *holds in zip(small["claim"], small["kind"], small["holds"], finite["holds"], strict=True):
        assert f"| {claim} | {kind} | {' | '.join(holds)} |" in page, "run `snakemake docs` and commit docs/claims.md"


def test_tables_read_back_from_csv_give_the_same_claims() -> None:
    scores = make_scores()
    correlations = correlate(scores)
    again = [pd.read_csv(io.StringIO(table.to_csv(index=False))) for table in (scores, correlations)]
    pd.testing.assert_frame_equal(claims_table(*again), claims_table(scores, correlations))
