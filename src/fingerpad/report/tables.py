"""The report's tables, as text: scores with errors, their accuracy, correlations. Rows are those of the CSV files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import median

from ..perception.wording import has_p, p_text, published_text, r2_text, range_text, slope_name, tau_text
from ..readouts.accuracy import relative_error, relative_errors
from ..rounding import rounded
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import INTERFACE_NAME, KINEMATICS_NAME, PERCENT, READOUT_NAME, SCORE_SCALE, score_label

Row = Mapping[str, str]
COLUMNS = [(interface, readout) for interface in Interface for readout in Readout]  # of scores, for each condition
NOTHING = "\N{EN DASH}"


@dataclass(frozen=True)
class Body:
    """Rows of one device: its title, and the name and cells of each."""

    title: str
    rows: tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True)
class Grid:
    """A table with two rows of headings: groups with the columns of each, then a body for each device."""

    groups: tuple[tuple[str, tuple[str, ...]], ...]
    bodies: tuple[Body, ...]


@dataclass(frozen=True)
class Listing:
    """A table with one row of headings, that of the rows' names first, and a body for each device."""

    columns: tuple[str, ...]
    bodies: tuple[Body, ...]


@dataclass(frozen=True)
class Statement:
    """A statement of the paper: its text, kind and source; what it was judged to be and on what evidence, by the name
    of kinematics.
    """

    text: str
    kind: str
    source: str
    judged: Mapping[str, tuple[str, str]]

    def holds(self, kinematics: str) -> str:
        """The verdict with kinematics of that name; nothing where there is none."""
        return self.judged.get(kinematics, ("", ""))[0]


def statement_listing(claims: Sequence[Row]) -> list[Statement]:
    """Every statement once, in the order of the table, with its verdicts side by side. claims: rows of claims.csv."""
    found: dict[str, Statement] = {}
    for row in claims:
        statement = found.setdefault(row["claim"], Statement(row["claim"], row["kind"], row["source"], {}))
        name = KINEMATICS_NAME[Kinematics(row["kinematics"])]
        found[row["claim"]] = replace(statement, judged={**statement.judged, name: (row["holds"], row["evidence"])})
    return list(found.values())


def score_with_error(row: Row) -> str:
    """A row's score and its stated error, in the unit that `score_label` names."""
    scale, _ = SCORE_SCALE[Readout(row["readout"])]
    return " ± ".join(rounded(scale * float(row["score"]), scale * _error_of(row)))


def score_grid(scores: Sequence[Row], titles: Mapping[str, str]) -> Grid:
    """Every score with its error. scores: rows of scores.csv. titles: of devices by name."""
    unit = scores[0]["unit"]
    return _grid(scores, titles, [score_label(readout, unit) for readout in Readout], score_with_error)


def score_notes(scores: Sequence[Row], titles: Mapping[str, str]) -> list[tuple[str, str, str]]:
    """What to know of scores, each once: title of the device, conditions and interfaces that it is about, and the note.
    Arguments as for `score_grid`.
    """
    found: dict[tuple[str, str], dict[str, dict[str, None]]] = {}
    for row in scores:
        if row["score"] and row["note"]:
            by_interface = found.setdefault((_titled(titles, row), row["note"]), {})
            by_interface.setdefault(INTERFACE_NAME[Interface(row["interface"])], {})[row["condition"]] = None
    return [
        (title, "; ".join(f"{', '.join(conditions)} ({interface})" for interface, conditions in about.items()), note)
        for (title, note), about in found.items()
    ]


def accuracy_grid(scores: Sequence[Row], titles: Mapping[str, str]) -> Grid:
    """Every score's error over the score [%]. Arguments as for `score_grid`."""
    names = [f"{READOUT_NAME[readout]} (%)" for readout in Readout]
    return _grid(scores, titles, names, lambda row: f"{PERCENT * relative_error(row):.2f}".replace("nan", "?"))


def _error_of(row: Row) -> float:
    """A score's stated error, in its unit; not a number if it is unknown."""
    return float(row["score_error"] or "nan")


def accuracy_summary(scores: Sequence[Row]) -> str:
    """Median and largest relative error of all scores, in words."""
    errors = relative_errors(scores)
    if not errors:
        return "No score has a known error."
    case = max(errors, key=lambda case: errors[case])
    kinematics, device, condition, interface, readout = case
    largest = errors[case]
    return (
        f"Of n = {len(errors)} scores the median stated error is {PERCENT * median(errors.values()):.2f} %, the largest"
        f" {PERCENT * largest:.2f} % ({KINEMATICS_NAME[Kinematics(kinematics)]}, {device}, {condition},"
        f" {INTERFACE_NAME[Interface(interface)]},"
        f" {READOUT_NAME[Readout(readout)].lower()})."
    )


def correlation_listing(correlations: Sequence[Row], titles: Mapping[str, str]) -> Listing:
    """The table of correlations, with those of CORRELATION_COLUMNS in which there is something. correlations: rows of
    correlations.csv.
    """
    found: dict[str, list[tuple[str, tuple[str, ...]]]] = {}
    for row in correlations:
        cells = (
            READOUT_NAME[Readout(row["readout"])],
            row["n"],
            tau_text(row) if row["kendall_tau"] else NOTHING,
            slope_name(row) if row["r2"] else NOTHING,
            range_text(row) or NOTHING,
            r2_text(row) if row["r2"] else NOTHING,
            p_text(row["p"]) if has_p(row["p"], row["rating_kind"]) else NOTHING,
            row["rating_kind"] or NOTHING,
            published_text(row) or NOTHING,
            row["note"] or NOTHING,
        )
        found.setdefault(_titled(titles, row), []).append((INTERFACE_NAME[Interface(row["interface"])], cells))
    every = [cells for rows in found.values() for _, cells in rows]
    kept = [number for number, column in enumerate(zip(*every, strict=True)) if any(cell != NOTHING for cell in column)]
    bodies = tuple(
        Body(title, tuple((name, tuple(cells[number] for number in kept)) for name, cells in rows))
        for title, rows in found.items()
    )
    first, *others = CORRELATION_COLUMNS
    return Listing((first, *(others[number] for number in kept)), bodies)


CORRELATION_COLUMNS = (
    "Interface", "Read-out", "n", "Kendall's τ", "Slope", "Range of R²", "R²", "p of R²", "Ratings",
    "Published", "Note",
)  # fmt: skip


def _titled(titles: Mapping[str, str], row: Row) -> str:
    """Title of a row's device, and its kinematics if they are finite."""
    finite = f", {KINEMATICS_NAME[Kinematics.FINITE]}" if row["kinematics"] == Kinematics.FINITE else ""
    return f"{titles[row['device']]}{finite}"


def _grid(scores: Sequence[Row], titles: Mapping[str, str], columns: Sequence[str], cell: Callable[[Row], str]) -> Grid:
    """Grid of what `cell` says of each score; where there is none, its note."""
    found: dict[str, dict[str, dict[tuple[str, str], str]]] = {}  # by title, condition, interface and read-out
    for row in scores:
        text = cell(row) if row["score"] else row["note"]
        found.setdefault(_titled(titles, row), {}).setdefault(row["condition"], {})[
            row["interface"], row["readout"]
        ] = text
    bodies = tuple(
        Body(
            title,
            tuple((name, tuple(cells.get(key, NOTHING) for key in COLUMNS)) for name, cells in conditions.items()),
        )
        for title, conditions in found.items()
    )
    return Grid(tuple((INTERFACE_NAME[interface].capitalize(), tuple(columns)) for interface in Interface), bodies)
