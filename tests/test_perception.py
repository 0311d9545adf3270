"""Ratings are checked, and the correlation and its range over all ordered ratings are what mathematics says."""

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from numpy.typing import NDArray
from scipy.optimize import nnls
from scipy.stats import kendalltau

from fingerpad.errors import RatingError
from fingerpad.perception.correlation import (
    COLUMNS,
    angle_of_errors,
    correlation_table,
    error_in_r,
    is_turned,
    tau_range,
)
from fingerpad.perception.extremes import rating_range, unit
from fingerpad.perception.order import order_matrix, up_sets
from fingerpad.perception.ratings import read_published, read_ratings, read_stated_order
from fingerpad.readouts.comparison import classes
from literature import CONDITIONS, LITERATURE

Array = NDArray[np.float64]
Matrix = NDArray[np.bool_]

CHAIN = np.triu(np.ones((3, 3), dtype=bool))
NO_ORDER = np.eye
DECIMALS = 1e-12  # of R² [1]; source: `rating_range` is rounded to twelve decimals


def stated_matrix(device: str) -> Matrix:
    order = LITERATURE.order
    return order_matrix(CONDITIONS[device], order[order["device"] == device])


def squared_correlation(x: Array, y: Array) -> float:
    return float(np.corrcoef(x, y)[0, 1] ** 2)


def random_order(rng: np.random.Generator, n: int) -> Matrix:
    """A random preorder: some pairs of a random ranking, some of them equal, closed under transitivity."""
    rank = rng.permutation(n)
    pairs = [(i, j) for i, j in itertools.permutations(range(n), 2) if rank[i] < rank[j] and rng.random() < 0.4]
    rows = [(str(i), "=" if rng.random() < 0.1 else "<", str(j)) for i, j in pairs]
    try:
        return order_matrix([str(i) for i in range(n)], frame(rows))
    except RatingError:  # an equality contradicts a strict pair
        return random_order(rng, n)


def random_rating(rng: np.random.Generator, at_most: Matrix) -> Array:
    """Ratings with this order: ascending random numbers, dealt out along a random linear extension."""
    n = len(at_most)
    values = np.sort(rng.random(n) ** rng.choice([0.02, 0.2, 1.0, 5.0, 50.0]))
    rating, left = np.full(n, np.nan), set(range(n))
    for value in values:
        least = [i for i in left if all(at_most[i, j] or not at_most[j, i] for j in left)]
        if not least:
            break
        chosen = rng.choice(least)
        same = [i for i in left if at_most[i, chosen] and at_most[chosen, i]]
        rating[same] = value
        left -= set(same)
    return rating


def frame(rows: list[tuple[str, str, str]]) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=["lower", "relation", "higher"])


# --- reading -------------------------------------------------------------------------------------------------------

HEADER = "device,condition,rating,kind,source"
DEVICE2 = [f"device2,{name},{i},surrogate,ordinal surrogate" for i, name in enumerate(CONDITIONS["device2"])]


def test_ratings_are_read_whatever_the_order_of_rows_and_columns(tmp_path: Path) -> None:
    path = tmp_path / "ratings.csv"
    path.write_text(
        "source,rating,device,kind,condition\n"
        "me,2.5,device2,measured,alternate_180\n\nme, 0 ,device2,measured,alternate_000\n"
        "me,1e0,device2,measured,alternate_090\n"
    )
    table = read_ratings(path, CONDITIONS)
    assert dict(zip(table["condition"], table["rating"], strict=True)) == {
        "alternate_180": 2.5,
        "alternate_000": 0.0,
        "alternate_090": 1.0,
    }
    assert list(table.columns) == HEADER.split(",")


@pytest.mark.parametrize("line_end", ["\r\n", "\n"])
def test_ratings_saved_by_a_spreadsheet_are_read(tmp_path: Path, line_end: str) -> None:
    path = tmp_path / "ratings.csv"
    path.write_bytes(("\ufeff" + line_end.join([HEADER, *DEVICE2])).encode())
    assert len(read_ratings(path, CONDITIONS)) == 3


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(RatingError, match=r"nowhere\.csv: cannot be read"):
        read_ratings(tmp_path / "nowhere.csv", CONDITIONS)


def test_a_file_that_is_no_text_is_named(tmp_path: Path) -> None:
    path = tmp_path / "ratings.csv"
    path.write_bytes(b"\xff\xfe\x00d")
    said = r"ratings\.csv, line 1: found a byte 0xff that is not UTF-8.*; save it as CSV UTF-8"
    with pytest.raises(RatingError, match=said):
        read_ratings(path, CONDITIONS)


@pytest.mark.parametrize(
    ("row", "part"),
    [
        ("device1,sheer,strain,0.5,1,x,y", "did you mean 'shear'"),
        ("device1,shear,strains,0.5,1,x,y", "did you mean 'strain'"),
        ("device1,shear,strain,1.5,1,x,y", "a number from 0 to 1"),
        ("device1,shear,strain,high,1,x,y", "a number from 0 to 1"),
        ("device1,shear,strain,0.5,rising,x,y", "1, -1, or nothing"),
        ("device1,shear,strain,0.5,1,x,y\ndevice1,shear,strain,0.7,1,x,y", "line 3.* one row per device, .* on line 2"),
    ],
)
def test_bad_published_values_are_named(tmp_path: Path, row: str, part: str) -> None:
    path = tmp_path / "published.csv"
    path.write_text(f"device,interface,readout,r2,slope,words,source\n{row}\n")
    with pytest.raises(RatingError, match=part):
        read_published(path)


# --- the stated order ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("names", [*itertools.permutations("abcd")])
def test_order_matrix_is_the_transitive_closure(names: tuple[str, ...]) -> None:
    """Wherever the conditions that relations go through stand among all."""
    at_most = order_matrix(names, frame([("a", "<", "b"), ("b", "=", "c"), ("c", "<", "d")]))
    place = ["abcd".index(name) for name in names]
    expected = np.array([[1, 1, 1, 1], [0, 1, 1, 1], [0, 1, 1, 1], [0, 0, 0, 1]], dtype=bool)
    np.testing.assert_array_equal(at_most, expected[np.ix_(place, place)])


@pytest.mark.parametrize(
    "rows",
    [
        [("a", "<", "a")],
        [("a", "<", "b"), ("b", "<", "c"), ("c", "<", "a")],
        [("a", "=", "b"), ("b", "=", "c"), ("a", "<", "c")],
    ],
)
def test_a_contradictory_order_is_an_error(rows: list[tuple[str, str, str]]) -> None:
    with pytest.raises(RatingError, match="contradicts itself"):
        order_matrix(["a", "b", "c"], frame(rows))


def test_an_order_of_unknown_conditions_is_an_error() -> None:
    with pytest.raises(RatingError, match="'z'"):
        order_matrix(["a", "b"], frame([("a", "<", "z")]))


@pytest.mark.parametrize("seed", range(20))
def test_up_sets_are_all_those_which_brute_force_finds(seed: int) -> None:
    at_most = random_order(np.random.default_rng(seed), 7)
    brute = [
        subset
        for subset in itertools.product((False, True), repeat=7)
        if 0 < sum(subset) < 7 and all(subset[j] for i in range(7) for j in range(7) if subset[i] and at_most[i, j])
    ]
    assert sorted(map(tuple, up_sets(at_most).tolist())) == sorted(brute)


@pytest.mark.parametrize(("count", "pairs", "message"), [(3, 2, "makes all ratings equal"), (20, 1, "65536 up-sets")])
def test_an_order_without_a_range_is_refused_as_it_is_read(
    count: int, pairs: int, message: str, tmp_path: Path
) -> None:
    """Before anything is computed."""
    names = [f"c{number}" for number in range(count)]
    rows = [f"own,{one},=,{other},us" for one, other in itertools.pairwise(names[: pairs + 1])]
    path = tmp_path / "order.csv"
    path.write_text("\n".join(["device,lower,relation,higher,source", *rows]), encoding="utf-8")
    with pytest.raises(RatingError, match=f"order.csv: own: the stated order .*{message}"):
        read_stated_order(path, {"own": names})


def test_device1_has_nine_up_sets() -> None:
    """Six conditions above the common one at 0° form a 2 by 3 grid, which has C(5, 2) = 10 up-sets, one empty."""
    assert len(up_sets(stated_matrix("device1"))) == math.comb(5, 2) - 1


def test_too_many_up_sets_are_an_error_with_a_name() -> None:
    assert len(up_sets(NO_ORDER(16, dtype=bool))) == 2**16 - 2
    with pytest.raises(RatingError, match="more than 65536 up-sets among 17 conditions"):
        up_sets(NO_ORDER(17, dtype=bool))


def test_a_long_chain_is_not_too_much() -> None:
    chain = np.triu(np.ones((60, 60), dtype=bool))
    assert rating_range(np.arange(60.0), chain).r2[1] == 1.0


# --- the range of R² -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("score", "expected"),
    [
        # a chain of three has the extreme ratings 0, 0, 1 and 0, 1, 1
        ([0.0, 1.0, 2.0], (0.75, 1.0)),
        ([2.0, 1.0, 0.0], (0.75, 1.0)),  # R² does not see the sign
        ([0.0, 2.0, 1.0], (0.0, 0.75)),  # the first is uncorrelated; the isotonic fit is 0, 1.5, 1.5
        ([0.0, 0.0, 1.0], (0.25, 1.0)),
        ([0.0, 1.0, 0.0], (0.0, 0.25)),  # opposite signs
    ],
)
def test_range_of_a_chain_of_three_in_closed_form(score: list[float], expected: tuple[float, float]) -> None:
    assert rating_range(np.array(score), CHAIN).r2 == pytest.approx(expected, abs=DECIMALS)


@pytest.mark.parametrize(
    ("device", "lowest_r2", "largest_r"), [("device1", 0.55, 0.2), ("device2", 0.75, 0.5), ("device3", 0.75, 0.5)]
)
def test_no_scores_correlate_very_well_or_weakly_with_every_rating_in_the_stated_order(
    device: str, lowest_r2: float, largest_r: float
) -> None:
    """What the page on claims says that an order cannot support: exact bounds, as tight as they are written.

    With unit generators e of the ratings, the lowest r of a score x is at one of them, and highest where x points at
    the point of their hull nearest to zero, whose distance it is. The largest |r| is at least that at some e; the least
    of it over x is 1 / |z| at the farthest corner z of the polytope |<e, z>| <= 1, found among all its corners.
    """
    at_most = stated_matrix(device)
    generators = unit(up_sets(at_most).astype(float))
    heavy = 1e4  # holds the sum of shares at 1
    shares = nnls(
        np.vstack([generators.T, np.full(len(generators), heavy)]), np.append(np.zeros(len(generators.T)), heavy)
    )
    nearest = generators.T @ shares[0] / shares[0].sum()
    assert lowest_r2 - 0.01 < nearest @ nearest <= lowest_r2 + 1e-6

    _, sizes, axes = np.linalg.svd(generators)
    inner = generators @ axes[: int((sizes > 1e-9).sum())].T  # in the space that they span
    signs = np.array(list(itertools.product([1.0, -1.0], repeat=inner.shape[1])))
    farthest = 0.0
    for chosen in itertools.combinations(range(len(inner)), inner.shape[1]):
        if abs(np.linalg.det(inner[list(chosen)])) > 1e-9:
            corners = np.linalg.solve(inner[list(chosen)], signs.T)
            inside = np.abs(inner @ corners).max(axis=0) <= 1.0 + 1e-9
            farthest = max(farthest, *np.linalg.norm(corners[:, inside], axis=0), 0.0)
    assert largest_r - 1e-6 <= 1.0 / farthest < largest_r + 0.01


def test_range_without_any_order_is_everything() -> None:
    assert rating_range(np.array([0.0, 1.0, 5.0]), NO_ORDER(3, dtype=bool)).r2 == (0.0, 1.0)


def test_two_conditions_always_lie_on_a_line() -> None:
    """The one case in which generators of both signs only cancel."""
    assert rating_range(np.array([3.0, 1.0]), NO_ORDER(2, dtype=bool)).r2 == (1.0, 1.0)


def test_a_score_that_varies_only_between_equally_rated_conditions_correlates_with_nothing() -> None:
    at_most = order_matrix(list("abc"), frame([("a", "=", "b"), ("b", "<", "c")]))
    assert rating_range(np.array([-1.0, 1.0, 0.0]), at_most).r2 == (0.0, 0.0)


def test_range_does_not_depend_on_scale_offset_or_sign_of_the_score() -> None:
    score = np.random.default_rng(1).random(9)
    at_most = stated_matrix("device1")
    expected = rating_range(score, at_most).r2
    for other in (1e-6 * score, 1e4 * score, score + 30.0, -score):
        assert rating_range(other, at_most).r2 == pytest.approx(expected, abs=DECIMALS)


def test_a_constant_score_and_an_order_of_equals_have_no_range() -> None:
    with pytest.raises(RatingError, match="score is constant"):
        rating_range(np.ones(3), CHAIN)
    with pytest.raises(RatingError, match="all ratings equal"):
        rating_range(np.arange(3.0), np.ones((3, 3), dtype=bool))


@pytest.mark.parametrize("device", CONDITIONS)
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_ten_thousand_random_ordered_ratings_lie_in_the_range(device: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    at_most = stated_matrix(device)
    score = rng.random(len(at_most)) + seed * random_rating(rng, at_most)  # from unrelated to well ordered
    low, high = rating_range(score, at_most).r2
    ratings = [random_rating(rng, at_most) for _ in range(10_000)]
    found = [squared_correlation(score, rating) for rating in ratings]
    assert low - DECIMALS <= min(found)
    assert max(found) <= high + DECIMALS
    assert min(found) < low + 0.1 * (high - low), "sampling should come near the lowest"
    assert max(found) > high - 0.2 * (high - low), "sampling should come near the highest"


@pytest.mark.parametrize("seed", range(60))
def test_extreme_ratings_have_the_order_and_attain_the_range(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 9))
    at_most = random_order(rng, n)
    score = rng.random(n)
    found = rating_range(score, at_most)
    for rating, expected in zip(found.ratings, found.r, strict=True):
        assert np.all(rating[:, None] - rating[None, :] <= np.where(at_most, 1e-12, np.inf))
        assert rating.min() == 0.0
        assert np.corrcoef(score, rating)[0, 1] == pytest.approx(expected, abs=DECIMALS)
    (low, high), (weakest, strongest) = found.r, found.r2
    for rating in (random_rating(rng, at_most) for _ in range(300)):
        if np.ptp(rating) > 0.0:
            r = np.corrcoef(score, rating)[0, 1]
            assert low - DECIMALS <= r <= high + DECIMALS
            assert weakest - DECIMALS <= r**2 <= strongest + DECIMALS


def isotonic(score: np.ndarray, at_most: np.ndarray) -> np.ndarray:
    """The nearest ratings with an order, written out: of all sets that hold what is above and contain a condition, the
    largest of the smallest means over what all sets that hold what is below leave of them."""
    whole = np.ones((1, score.size))
    above = np.vstack([up_sets(at_most), whole])
    below = np.vstack([~up_sets(at_most), whole])
    count = above @ below.T
    mean = np.divide((above * score) @ below.T, count, out=np.full(count.shape, np.nan), where=count > 0.0)
    return np.array([mean[above[:, i] == 1.0][:, below[:, i] == 1.0].min(axis=1).max() for i in range(score.size)])


@pytest.mark.parametrize("seed", range(40))
def test_highest_r2_is_that_of_isotonic_regression(seed: int) -> None:
    """On a chain, and in Device 1's order, in which three conditions are one stimulus and so have one score."""
    rng = np.random.default_rng(seed)
    score = rng.lognormal(0.0, 0.5, 9)
    tied = score.copy()
    tied[CONDITIONS["device1"].index("medium_000")] = tied[CONDITIONS["device1"].index("high_000")] = tied[0]
    for given, at_most in ((score[:3], CHAIN), (tied, stated_matrix("device1"))):
        fits = [isotonic(given, at_most), isotonic(-given, at_most)]
        expected = max(np.var(fit) / np.var(given) for fit in fits)
        assert rating_range(given, at_most).r2[1] == pytest.approx(expected, abs=DECIMALS)


def test_a_score_that_falls_throughout_has_its_highest_r_with_two_classes() -> None:
    """Four in a chain; of the steps 0001, 0011 and 0111, centred, the second has norm 1, the others sqrt(3)/2. With the
    first the product with the scores is -1, the largest, but r is larger with the second, where it is -1.1.
    """
    score = np.array([1.05, 0.05, -0.1, -1.0])
    found = rating_range(score, np.triu(np.ones((4, 4), dtype=bool)))
    assert found.r[1] == pytest.approx(-1.1 / np.linalg.norm(score), abs=DECIMALS)


def test_slopes_of_two_classes_without_order_have_both_signs_and_no_zero() -> None:
    at_most = order_matrix(list("abc"), frame([("a", "=", "b")]))
    found = rating_range(np.array([1.0, 1.1, 3.0]), at_most)
    assert found.r[0] == -found.r[1] < -0.99
    assert found.r2[0] == found.r2[1]


# --- the table -----------------------------------------------------------------------------------------------------


def make_scores(device: str, values: list[float], interface: str = "shear", note: object = "") -> pd.DataFrame:
    return pd.DataFrame(
        {
            "kinematics": "small",
            "device": device,
            "condition": CONDITIONS[device] if device in CONDITIONS else [f"c{i}" for i in range(len(values))],
            "interface": interface,
            "readout": "strain",
            "score": values,
            "score_error": 0.25,
            "note": note,
        }
    )


def make_table(scores: pd.DataFrame, ratings: pd.DataFrame | None = None) -> pd.DataFrame:
    """The table with the shipped data, or with other ratings."""
    return correlation_table(scores, LITERATURE if ratings is None else replace(LITERATURE, ratings=ratings))


def test_correlation_of_three_points_in_closed_form() -> None:
    """r of 0, 2, 1 with 1, 2, 3 is 1/2; with one degree of freedom p = 1 - 2/pi arctan(r / sqrt(1 - r²))."""
    row = make_table(make_scores("device2", [0.0, 2.0, 1.0])).iloc[0]
    assert row["n"] == 3
    assert row["slope_sign"] == 1
    # errors of 0.25 turn scores most where they become 0.25, 2.25, 0.75; r moves from the cosine of 60 degrees
    ends = np.cos(math.pi / 3.0 + np.array([-1.0, 1.0]) * math.acos(math.sqrt(12.0 / 13.0)))
    assert row["r_error"] == pytest.approx(max(ends[0] - 0.5, 0.5 - ends[1]))
    assert row["r2"] == pytest.approx(0.25)
    assert row["p"] == pytest.approx(1.0 - 2.0 / math.pi * math.atan(0.5 / math.sqrt(0.75)))
    assert row["kendall_tau"] == pytest.approx(1.0 / 3.0)
    assert (row["tau_lowest"], row["tau_highest"]) == pytest.approx((1.0 / 3.0, 1.0 / 3.0))  # no pair is within errors
    assert (row["r2_lowest"], row["r2_highest"]) == pytest.approx((0.0, 0.75), abs=DECIMALS)
    assert (row["published_r2"], row["published_slope"]) == (0.989, 1)
    assert row["rating_kind"] == "ordinal surrogate"
    assert row["note"] == ""


@pytest.mark.parametrize("seed", range(20))
def test_errors_move_r_by_no_more_than_is_said_and_by_half_of_it(seed: int) -> None:
    """Over all corners of the box of errors, from small ones to some that leave the slope open. Half: the bound takes
    all errors for ones that turn scores towards the ratings, or away.
    """
    random = np.random.default_rng(seed)
    score, rating = random.uniform(1.0, 2.0, 5), random.uniform(0.0, 1.0, 5)
    error = random.uniform(0.5, 1.0, 5) * 10.0 ** random.uniform(-5.0, -0.8)
    moved = np.abs(r_at_corners(score, rating, error) - np.corrcoef(score, rating)[0, 1]).max()
    assert 0.5 < moved / error_of(score, rating, error) <= 1.0


@pytest.mark.parametrize("seed", range(10))
def test_the_angle_of_many_scores_is_no_less_than_that_of_their_corners(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With less than 1.2 times their angle: errors of one size lie nearly across the scores in some corner."""
    random = np.random.default_rng(seed)
    score, error = random.uniform(1.0, 2.0, 8), np.full(8, 10.0 ** random.uniform(-4.0, -1.3))
    exact = angle_of_errors(score, error)
    monkeypatch.setattr("fingerpad.perception.correlation.MOST_CORNERS", 7)
    assert exact <= angle_of_errors(score, error) < 1.2 * exact
    assert angle_of_errors(score, np.full(8, 1.0)) == math.pi


@pytest.mark.parametrize("r", [-0.5, 0.0, 0.5])
def test_errors_that_turn_scores_to_the_ratings_or_away_make_r_one_or_minus_one(r: float) -> None:
    """And no less where they turn them further: pi stands for every angle."""
    for angle in (2.2, 3.0, math.pi):  # the ratings' own, at most 2.1 from the scores, or from what opposes them
        assert error_in_r(r, angle) == pytest.approx(1.0 + abs(r), abs=1e-12)


def test_errors_move_r_where_it_is_one() -> None:
    """There nothing moves it to the first order, and yet errors of 0.4 in scores 1, 2, 3 bring it down to 0.91."""
    score, error = np.array([1.0, 2.0, 3.0]), np.full(3, 0.4)
    lowest = r_at_corners(score, score, error).min()
    assert lowest == pytest.approx(0.9078, abs=1e-4)
    assert 1.0 - lowest < error_of(score, score, error) < 2.0 * (1.0 - lowest)


def error_of(score: np.ndarray, rating: np.ndarray, error: np.ndarray) -> float:
    """What errors of scores (n,) can change in r with ratings (n,)."""
    return error_in_r(float(np.corrcoef(score, rating)[0, 1]), angle_of_errors(score, error))


def r_at_corners(score: np.ndarray, rating: np.ndarray, error: np.ndarray) -> np.ndarray:
    """r (2^n,) of ratings (n,) with the scores at all corners of the box of their errors."""
    corners = score + error * np.array(list(itertools.product((-1.0, 1.0), repeat=score.size)))
    return np.array([np.corrcoef(corner, rating)[0, 1] for corner in corners])


@pytest.mark.parametrize("scale", [0.5, 0.99, 1.01, 2.0])
def test_errors_beyond_r_leave_the_slope_open_and_others_do_not(scale: float) -> None:
    """Scores 1, 3, 2 with ratings 1, 2, 3: the slope vanishes as soon as the outer ones come closer by their distance,
    each by 0.5."""
    score, rating = np.array([1.0, 3.0, 2.0]), np.array([1.0, 2.0, 3.0])
    assert is_turned(score, rating, np.full(3, 0.5 * scale)) is (scale > 1.0)
    assert bool(r_at_corners(score, rating, np.full(3, 0.5 * scale)).min() < 0.0) is (scale > 1.0)


def test_errors_that_leave_the_sign_may_still_raise_r_by_more_than_itself() -> None:
    """Where scores' errors rival their spread; over the corners of the box of errors r goes up by 0.48, from 0.26."""
    score, rating = np.array([3.765, 5.611, 4.379]), np.array([-1.884, -0.778, 0.640])
    error = np.array([0.168, 0.946, 0.119])
    r, found = np.corrcoef(score, rating)[0, 1], r_at_corners(score, rating, error)
    assert found.min() > 0.0
    assert not is_turned(score, rating, error)
    assert error_of(score, rating, error) > found.max() - r > r


def test_where_ratings_in_the_order_disagree_on_the_slope_it_is_open() -> None:
    """With ratings 0, 0, 1 it falls and with 0, 1, 1 it rises, both beyond the errors; with 0, 1, 5 it is level."""
    score, error = np.array([0.0, 3.0, 1.0]), np.full(3, 0.01)
    over = rating_range(score, CHAIN)
    assert not any(is_turned(score, rating, error) for rating in over.generators)
    assert is_turned(score, np.array([0.0, 1.0, 5.0]), error)
    for errors, is_open in ((error, 1), (0.0 * error, 0)):
        row = make_table(make_scores("device2", list(score)).assign(score_error=errors)).iloc[0]
        assert row["r_lowest"] < 0.0 < row["r_highest"]
        assert row["range_open"] == is_open


def test_scores_that_only_rounding_tells_apart_are_constant() -> None:
    row = make_table(make_scores("device2", [1.0, 1.0 + 2e-8, 1.0 + 3e-8])).iloc[0]
    assert row["note"] == "constant score"
    assert pd.isna(row["r2"])


def test_a_slope_that_turns_with_some_rating_in_the_order_is_open() -> None:
    """With the lowest and the highest r errors leave it negative; with ratings 0, 1, 1 they do not."""
    scores = make_scores("device2", [-2.556, -1.969, -0.388]).assign(score_error=[0.069, 1.384, 1.222])
    row = make_table(scores).iloc[0]
    assert 0.0 < row["r_lowest"] < row["range_error"]
    assert (row["slope_open"], row["range_open"]) == (0, 1)
    x, error = scores["score"].to_numpy(), scores["score_error"].to_numpy()
    assert not any(is_turned(x, rating, error) for rating in rating_range(x, CHAIN).ratings)


def test_ratings_that_are_equal_where_one_is_stated_to_be_less_contradict_it() -> None:
    rated = pd.DataFrame({"device": "device2", "condition": CONDITIONS["device2"], "rating": [1.0, 1.0, 2.0]})
    row = make_table(make_scores("device2", [1.0, 2.0, 3.0]), rated.assign(kind="measured", source="")).iloc[0]
    assert row["note"] == "ratings contradict the stated order"


def test_ratings_of_one_stimulus_that_differ_are_noted_as_such() -> None:
    rating = np.round(1.0 + np.outer([1.0, 2.0, 3.0], [0.0, 0.5, 1.0]).ravel() / 3.0, 4)
    rating[3] += 0.01
    rated = pd.DataFrame({"device": "device1", "condition": CONDITIONS["device1"], "rating": rating})
    scores = make_scores("device1", [1.0, 2.0, 3.0, 1.0, 4.0, 5.0, 1.0, 6.0, 7.0])
    row = make_table(scores, rated.assign(kind="measured", source="")).iloc[0]
    assert row["note"] == "7 of 9 conditions are distinct; ratings differ that are stated to be equal"


def test_a_falling_score_has_a_negative_slope() -> None:
    row = make_table(make_scores("device3", [2.0, 1.0, 3.0])).iloc[0]
    assert row["slope_sign"] == -1
    assert row["spread"] == pytest.approx(1.0)  # 3 less 1, over the mean of 2
    assert row["kendall_tau"] == pytest.approx(-1.0)
    assert math.isnan(row["published_r2"])
    assert row["published_words"] == "negative correlation"


def test_device1_counts_nine_conditions_and_says_that_seven_are_distinct() -> None:
    row = make_table(make_scores("device1", [1.0, 2.0, 3.0, 1.0, 4.0, 5.0, 1.0, 6.0, 7.0])).iloc[0]
    assert row["n"] == 9
    assert row["note"] == "7 of 9 conditions are distinct"
    assert 0.0 < row["r2_lowest"] <= row["r2"] <= row["r2_highest"] <= 1.0
    expected = squared_correlation(
        np.array([1.0, 2.0, 3.0, 1.0, 4.0, 5.0, 1.0, 6.0, 7.0]),
        np.round(1.0 + np.outer([1.0, 2.0, 3.0], [0.0, 0.5, 1.0]).ravel() / 3.0, 4),  # as in data/ratings.csv
    )
    assert row["r2"] == pytest.approx(expected)


@pytest.mark.parametrize("size", [2, 3, 5, 9])
def test_errors_take_tau_to_no_place_beyond_its_range(size: int) -> None:
    """Scores anywhere within their errors; two of them that are far apart reach both ends."""
    random = np.random.default_rng(size)
    for _ in range(20):
        score, error = random.uniform(0.0, 1.0, size), random.uniform(0.0, 0.2, size)
        rating = random.integers(0, 4, size).astype(float)
        rating[:2] = 0.0, 1.0  # not all equal
        lowest, highest = tau_range(np.arange(size), score, error, rating)
        within = [kendalltau(score + random.uniform(-1.0, 1.0, size) * error, rating).statistic for _ in range(50)]
        assert lowest - 1e-12 <= min(within)
        assert max(within) <= highest + 1e-12
        assert tau_range(np.arange(size), score, 0.0 * error, rating) == pytest.approx(
            (kendalltau(score, rating).statistic,) * 2
        )


def test_tau_of_tied_scores_without_errors_is_one_value() -> None:
    """Kendall's tau-b, which counts no pair that is tied in scores or in ratings."""
    score, rating = np.array([1.0, 1.0, 2.0, 3.0, 2.5]), np.array([1.0, 2.0, 3.0, 3.0, 1.0])
    tau = kendalltau(score, rating).statistic
    assert tau_range(classes(score), score, np.zeros(5), rating) == pytest.approx((tau, tau))


def test_scores_whose_errors_just_meet_may_have_either_order() -> None:
    """As wherever scores are compared. Halves are exact."""
    score, error = np.array([1.0, 2.0]), np.array([0.5, 0.5])
    assert tau_range(np.arange(2), score, error, np.arange(2.0)) == (-1.0, 1.0)


def test_tau_has_no_range_where_errors_are_not_known() -> None:
    assert np.isnan(tau_range(np.arange(2), np.array([1.0, 2.0]), np.array([0.1, np.nan]), np.arange(2.0))).all()


@pytest.mark.parametrize("noise", [0.0, 1e-9, -1e-9])
def test_scores_that_only_rounding_tells_apart_are_tied(noise: float) -> None:
    """As those of mirrored stimuli: two pairs of scores, each pair tied."""
    scores, ratings = [1.0, 1.0 + noise, 2.0, 2.0 - noise, 3.0], [2.0, 1.0, 4.0, 3.0, 5.0]
    measured = pd.DataFrame({"device": "own", "condition": [f"c{i}" for i in range(5)], "rating": ratings})
    row = make_table(make_scores("own", scores), measured.assign(kind="measured", source="")).iloc[0]
    assert row["kendall_tau"] == pytest.approx(8.0 / math.sqrt(8.0 * 10.0))
    assert row["note"] == "3 of 5 conditions are distinct"


def test_ratings_whose_means_are_one_but_for_rounding_have_no_p() -> None:
    """Two pairs share a stimulus each: their mean ratings, and that of the fifth condition, are 0.15."""
    ratings = pd.DataFrame(
        {"device": "own", "condition": [f"c{i}" for i in range(5)], "rating": [0.1, 0.2, 0.1, 0.2, 0.15]}
    )
    row = make_table(make_scores("own", [1.0, 1.0, 2.0, 2.0, 3.0]), ratings.assign(kind="measured", source="")).iloc[0]
    assert math.isnan(row["p"])


def test_conditions_with_one_stimulus_count_once_whatever_is_stated() -> None:
    """Three of five share a stimulus, rated 1, 2 and 3: p is that of three conditions, the first rated 2."""
    scores, ratings = [1.0, 1.0, 1.0, 2.0, 3.0], [1.0, 2.0, 3.0, 5.0, 4.0]
    measured = pd.DataFrame({"device": "own", "condition": [f"c{i}" for i in range(5)], "rating": ratings})
    row = make_table(make_scores("own", scores), measured.assign(kind="measured", source="")).iloc[0]
    r = squared_correlation(np.array([1.0, 2.0, 3.0]), np.array([2.0, 5.0, 4.0])) ** 0.5
    assert row["p"] == pytest.approx(1.0 - 2.0 / math.pi * math.atan(r / math.sqrt(1.0 - r**2)))
    assert row["note"] == "3 of 5 conditions are distinct"
    assert row["r2"] == pytest.approx(squared_correlation(np.array(scores), np.array(ratings)))


def test_columns_and_one_row_for_each_device_interface_and_readout() -> None:
    scores = pd.concat(
        [make_scores("device2", [1.0, 2.0, 4.0]), make_scores("device2", [1.0, 2.0, 4.0], interface="frictionless")]
    )
    table = make_table(scores)
    assert list(table.columns) == COLUMNS
    assert table[["device", "interface", "readout"]].to_numpy().tolist() == [
        ["device2", "shear", "strain"],
        ["device2", "frictionless", "strain"],
    ]
    assert list(make_table(scores.iloc[:0]).columns) == COLUMNS


@pytest.mark.parametrize("note", ["no prediction", "", math.nan])
def test_no_prediction_gives_no_number(note: object) -> None:
    row = make_table(make_scores("device3", [math.nan] * 3, "frictionless", note)).iloc[0]
    assert row["n"] == 0
    assert row[["slope_sign", "r2", "r2_lowest", "r2_highest", "kendall_tau", "p"]].isna().all()
    assert row["note"] == "no prediction"


def test_one_missing_score_leaves_nothing_to_correlate() -> None:
    row = make_table(make_scores("device2", [1.0, math.nan, 2.0])).iloc[0]
    assert row["n"] == 0
    assert math.isnan(row["r2"])


@pytest.mark.parametrize("values", [[0.3, 0.3, 0.3], [0.3, 0.3 * (1 + 1e-12), 0.3], [0.0, 0.0, 0.0]])
def test_a_constant_score_has_no_r2(values: list[float]) -> None:
    row = make_table(make_scores("device2", values)).iloc[0]
    assert row["n"] == 3
    assert row[["slope_sign", "r2", "r2_lowest", "r2_highest", "kendall_tau", "p"]].isna().all()
    assert row["note"] == "constant score"


def test_a_device_without_ratings_is_said_to_have_none() -> None:
    row = make_table(make_scores("mine", [1.0, 2.0, 3.0])).iloc[0]
    assert row["n"] == 0
    assert math.isnan(row["r2"])
    assert row["note"] == "no ratings"
    assert row["rating_kind"] == ""
    assert row["published_words"] == ""


def make_ratings(device: str, values: list[float], kind: str = "measured") -> pd.DataFrame:
    names = CONDITIONS[device] if device in CONDITIONS else [f"c{i}" for i in range(len(values))]
    return pd.DataFrame({"device": device, "condition": names, "rating": values, "kind": kind, "source": "test"})


def test_a_device_without_stated_order_has_no_range() -> None:
    row = make_table(make_scores("mine", [1.0, 2.0, 4.0]), make_ratings("mine", [1.0, 2.0, 4.0])).iloc[0]
    assert row["r2"] == pytest.approx(1.0)
    assert math.isnan(row["r2_lowest"])
    assert math.isnan(row["r2_highest"])
    assert row["rating_kind"] == "measured"


def test_measured_ratings_which_contradict_the_stated_order_are_noted() -> None:
    row = make_table(make_scores("device2", [1.0, 2.0, 4.0]), make_ratings("device2", [3.0, 2.0, 1.0])).iloc[0]
    assert row["note"] == "ratings contradict the stated order"
    assert row["slope_sign"] == -1


@pytest.mark.parametrize(
    ("count", "ratings", "note"),
    [(3, [1.0, 1.0, 1.0], "constant rating"), (2, [1.0, 2.0], "fewer than three"), (1, [1.0], "fewer than three")],
)
def test_ratings_that_allow_no_correlation_are_noted(count: int, ratings: list[float], note: str) -> None:
    row = make_table(make_scores("mine", [1.0, 2.0, 4.0][:count]), make_ratings("mine", ratings)).iloc[0]
    assert math.isnan(row["r2"])
    assert note in row["note"]


def test_rows_are_matched_by_condition_and_not_by_place() -> None:
    scores = make_scores("device1", [1.0, 2.0, 3.0, 1.0, 4.0, 5.0, 1.0, 6.0, 7.0])
    table = make_table(scores)
    shuffled = make_table(scores.sample(frac=1.0, random_state=0))
    pd.testing.assert_frame_equal(table, shuffled)


def test_scores_and_ratings_of_different_conditions_are_an_error() -> None:
    with pytest.raises(RatingError, match=r"device2, shear, strain.*'alternate_180'"):
        make_table(make_scores("device2", [1.0, 2.0, 3.0]).iloc[:2])
