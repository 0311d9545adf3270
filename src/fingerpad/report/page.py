"""The report as one HTML page that can be sent: everything that it shows is in it."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from ..perception.claims import verdict_counts
from ..perception.ratings import RatingKind
from ..perception.verdicts import Holds
from ..scene.sources import Origin, Quantity
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME
from .captions import Results, Words, words
from .provenance import Provenance
from .tables import (
    Row,
    accuracy_grid,
    accuracy_summary,
    correlation_listing,
    score_grid,
    score_notes,
    statement_listing,
)


@dataclass(frozen=True)
class Picture:
    """A figure of the page: anchor, what is said of it, and its PNG as a data URI."""

    anchor: str
    words: Words
    uri: str


def pictures_of(files: Sequence[Path], results: Results) -> list[Picture]:
    """Figures from their PNG files, in the order in which they are read. Raises KeyError as `words` does."""
    by_stem = {path.stem: path for path in files}
    return [Picture(stem, said, data_uri(by_stem[stem])) for stem, said in words(by_stem, results).items()]


def data_uri(png: Path) -> str:
    """A PNG file as a data URI."""
    return f"data:image/png;base64,{base64.b64encode(png.read_bytes()).decode('ascii')}"


def report(
    template: str,
    results: Results,
    claims: Sequence[Row],
    of_model: Sequence[Quantity],
    of_devices: Mapping[str, Sequence[Quantity]],
    pictures: Sequence[Picture],
    graph: Picture,
    made: Provenance,
) -> str:
    """The page. Same arguments, same text.

    template: Jinja's, in which all text is escaped. claims: rows of claims.csv. of_model, of_devices: quantities of
    config.yaml and of each device's scene file, of which the assumptions are listed. graph: of the rules that the run
    consists of.
    """
    titles = {scene.device.name: scene.device.title for scene in results.scenes}
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return environment.from_string(template).render(
        titles=titles,
        scores=score_grid(results.scores, titles),
        notes=score_notes(results.scores, titles),
        accuracy=accuracy_grid(results.scores, titles),
        accuracy_summary=accuracy_summary(results.scores),
        correlations=correlation_listing(results.correlations, titles),
        surrogates=any(row["rating_kind"] == RatingKind.SURROGATE.label for row in results.correlations),
        statements=statement_listing(claims),
        judged_with=list(dict.fromkeys(KINEMATICS_NAME[Kinematics(row["kinematics"])] for row in claims)),
        verdicts=list(map(str, Holds)),
        counts={KINEMATICS_NAME[Kinematics(each)]: counts for each, counts in verdict_counts(claims).items()},
        assumptions=[
            (heading, [each for each in listed if each.origin is Origin.ASSUMPTION])
            for heading, listed in (("The model", of_model), *((titles[name], of_devices[name]) for name in titles))
        ],
        pictures=pictures,
        graph=graph,
        made=made,
    )
