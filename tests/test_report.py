"""The report: one page that holds all it shows, says what the tables say, and comes out the same every time."""

from __future__ import annotations

import base64
import dataclasses
import re
import runpy
from collections.abc import Mapping, Sequence
from html import unescape
from html.parser import HTMLParser
from itertools import combinations, pairwise
from pathlib import Path

import pytest

from fingerpad.digraph import layers, placed, read_dot, reduced
from fingerpad.figures.rules import rules_figure
from fingerpad.pages.assumptions import page
from fingerpad.perception.ratings import RatingKind
from fingerpad.perception.wording import OPEN_SLOPE, SURROGATE, p_text, r2_text
from fingerpad.report.captions import Results, Words, rules_words, words
from fingerpad.report.page import Picture, data_uri, pictures_of, report
from fingerpad.report.provenance import provenance
from fingerpad.report.tables import (
    accuracy_grid,
    accuracy_summary,
    correlation_listing,
    score_grid,
    score_notes,
    score_with_error,
)
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.readout import Readout
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.sources import Origin, quantities
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.store import read_rows
from fingerpad.words import COVERED, INTERFACE_NAME

ROOT = Path(__file__).parents[1]
CONFIG = ROOT / "config" / "config.yaml"
DEVICES = [ROOT / "config" / "devices" / f"device{number}.yaml" for number in (2, 3)]
TEMPLATE = ROOT / "workflow" / "report" / "report.html"
PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)
FIGURES = ["map_small_device3-alternate", "figure_6_shear", "section", "figure_3_workflow", "figure_4_receptors"]
FIGURES += ["figure_5_correlation", "ablation_shear"]
TRICK = "<script>alert('no')</script>"  # what a table may say is text, never markup


def score(device: str, phase: int, interface: Interface, readout: Readout, value: str) -> dict[str, str]:
    """A row of scores.csv, or one without a prediction."""
    said = {"score": value, "score_error": "0.0012" if value else "", "unit": "mm2"}
    name = f"alternate_{phase:03}"
    note = "" if value else "no prediction"
    where = {
        "kinematics": "small",
        "device": device,
        "condition": name,
        "dispersion": "alternate",
        "phase_deg": str(float(phase)),
    }
    return where | {"interface": str(interface), "readout": str(readout)} | said | {"note": note}


def correlation(device: str, interface: Interface, readout: Readout, r2: str) -> dict[str, str]:
    """A row of correlations.csv, or one without numbers."""
    found = {
        "slope_sign": "-1",
        "r2": r2,
        "r_error": "0.1",
        "slope_open": "0",
        "range_open": "0",
        "r2_lowest": "0.25",
        "r2_highest": "0.75",
        "kendall_tau": "-0.5",
        "tau_lowest": "-0.5",
        "tau_highest": "-0.5",
        "p": "0.03",
    }
    numbers = found if r2 else dict.fromkeys(found, "")
    where = {
        "kinematics": "small",
        "device": device,
        "interface": str(interface),
        "readout": str(readout),
        "n": "3" if r2 else "0",
    }
    last = {"rating_kind": "ordinal surrogate", "note": "" if r2 else "no prediction"}
    return where | numbers | {"published_r2": "", "published_slope": "", "published_words": TRICK} | last


@pytest.fixture
def results() -> Results:
    """Two devices; the second makes no prediction without shear."""
    cases = [
        (device, interface, readout)
        for interface in Interface
        for device in ("device2", "device3")
        for readout in Readout
    ]
    silent = ("device3", Interface.FRICTIONLESS)
    return Results(
        tuple(load_scene(CONFIG, path) for path in DEVICES),
        tuple(score(*case[:1], phase, *case[1:], "" if case[:2] == silent else "0.4321")
              for case in cases for phase in (0, 90, 180)),
        tuple(correlation(*case, "" if case[:2] == silent else "0.625") for case in cases),
        "device2",
    )  # fmt: skip


@pytest.fixture
def html(results: Results, tmp_path: Path) -> str:
    return built(results, tmp_path)


CLAIMS = [
    {
        "kinematics": kinematics,
        "claim": claim,
        "kind": "stated",
        "source": "paper: Results",
        "holds": holds,
        "evidence": evidence,
    }
    for kinematics, claim, holds, evidence in (
        ("small", "It rises.", "yes", TRICK),
        ("finite", "It falls.", "no", "no"),
    )
]


def built(results: Results, folder: Path, claims: Sequence[Mapping[str, str]] = CLAIMS) -> str:
    """The page of these results, with one pixel for each figure."""
    for stem in FIGURES:
        (folder / f"{stem}.png").write_bytes(PIXEL)
    return report(
        TEMPLATE.read_text(encoding="utf-8"),
        results,
        claims,
        quantities(read_yaml(CONFIG)),
        {path.stem: quantities(read_yaml(path)) for path in DEVICES},
        pictures_of([folder / f"{stem}.png" for stem in FIGURES], results),
        Picture("rules", Words("Rules", "Boxes.", "n = 2 rules."), data_uri(folder / "section.png")),
        provenance(ROOT / "pyproject.toml", "0123abc", [CONFIG, *DEVICES]),
    )


class Parsed(HTMLParser):
    """Tags with their attributes, in the order of the page; void and optional ends are written out or known."""

    VOID = frozenset({"meta", "img", "br", "link"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, Mapping[str, str | None]]] = []
        self.open: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def every(self, attribute: str, tag: str | None = None) -> list[str]:
        """Values of an attribute, of all tags or one kind."""
        return [str(found[attribute]) for name, found in self.tags if attribute in found and tag in {None, name}]


def test_page_is_well_formed(html: str) -> None:
    assert html.lstrip().startswith("<!DOCTYPE html>")
    parsed = Parsed(html)
    assert parsed.open == []
    anchors = parsed.every("id")
    assert len(set(anchors)) == len(anchors)
    assert [tag for tag, _ in parsed.tags].count("h1") == 1


def test_a_condition_at_rest_has_no_relative_error(results: Results, tmp_path: Path) -> None:
    """Its change of strain is zero, and so is the error: that says nothing about others."""
    first, *others = results.scores
    html = built(
        dataclasses.replace(results, scores=({**first, "score": "0.0", "score_error": "0.0"}, *others)), tmp_path
    )
    assert "<td>?</td>" in html
    assert f"Of n = {sum(1 for row in others if row['score'])} scores" in html


def test_a_run_without_the_papers_devices_has_none_of_its_statements(results: Results, tmp_path: Path) -> None:
    said = "none of these is in this run"
    assert said in built(results, tmp_path, claims=[])
    assert said not in built(results, tmp_path)


def test_every_picture_is_in_the_page_and_has_an_alternative(html: str) -> None:
    pictures = [found for tag, found in Parsed(html).tags if tag == "img"]
    assert len(pictures) == len(FIGURES) + 1
    for picture in pictures:
        kind, _, data = str(picture["src"]).partition(",")
        assert kind == "data:image/png;base64"
        assert base64.b64decode(data) == PIXEL
        assert picture["alt"]


def test_every_link_leads_to_a_place_in_the_page(html: str) -> None:
    parsed = Parsed(html)
    links = parsed.every("href")
    assert links
    assert all(link.startswith("#") for link in links)
    assert {link[1:] for link in links} <= set(parsed.every("id"))
    assert set(parsed.every("aria-labelledby")) <= set(parsed.every("id"))
    headings = {str(found["id"]) for tag, found in parsed.tags if tag == "h2"}
    assert headings <= {link[1:] for link in links}


def test_nothing_is_loaded_from_anywhere(html: str) -> None:
    assert not re.search(r"https?:|//[a-z]|url\(|@import|<script|<link|<iframe", html)


def test_text_from_tables_is_no_markup(html: str) -> None:
    assert TRICK not in html
    assert "&lt;script&gt;" in html


def test_same_inputs_same_bytes(results: Results, html: str, tmp_path: Path) -> None:
    assert built(results, tmp_path) == html


def test_page_holds_no_path_of_this_machine(html: str, tmp_path: Path) -> None:
    assert str(ROOT) not in html
    assert str(tmp_path) not in html


def test_page_says_what_the_tables_say(html: str) -> None:
    text = unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", html)))
    assert "0.4321 ± 0.0012" in text
    assert "τ = −0.50, falling, R² range 0.25 to 0.75, surrogates' R² = 0.62, n = 3" in text  # noqa: RUF001  # as typeset
    assert text.count("no prediction") > 12
    assert "Ratings are ordinal surrogates." in text
    assert "0123abc" in text
    for path in (CONFIG, *DEVICES):
        for quantity in quantities(read_yaml(path)):
            if quantity.origin is Origin.ASSUMPTION:
                assert quantity.key in text


def cells(html: str, table: str) -> list[list[str]]:
    """Rows of a table of that class, as text."""
    (found,) = re.findall(rf'<table class="{table}">(.*?)</table>', html, re.DOTALL)
    rows = re.findall(r"<tr>(.*?)</tr>", found, re.DOTALL)
    return [
        [" ".join(cell.split()) for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row, re.DOTALL)] for row in rows
    ]


def test_what_came_out_comes_before_all_evidence(results: Results, tmp_path: Path) -> None:
    """Counts of stated statements and all verdicts side by side; a statement without a verdict has a dash there."""
    made = [
        {"kinematics": kinematics, "claim": claim, "kind": kind, "source": "paper", "holds": holds, "evidence": "Seen."}
        for kinematics, claim, kind, holds in (
            ("small", "It rises.", "stated", "yes"),
            ("small", "It bends.", "weaker", "no"),
            ("small", "It falls.", "stated", "undecided"),
            ("small", "It stays.", "stated", "yes"),
            ("finite", "It rises.", "stated", "no"),
            ("finite", "It bends.", "weaker", "yes"),
            ("finite", "It stays.", "stated", "yes"),
        )
    ]
    html = built(results, tmp_path, made)
    assert cells(html, "counts") == [
        ["Kinematics", "yes", "no", "undecided", "n"],
        ["small strain", "2", "0", "1", "3"],
        ["finite strain", "1", "1", "0", "2"],
    ]
    assert cells(html, "outcome") == [
        ["Statement", "small strain", "finite strain"],
        ["Stated"],
        ["It rises.", "yes", "no"],
        ["It falls.", "undecided", "\N{EN DASH}"],
        ["It stays.", "yes", "yes"],
        ["Weaker"],
        ["It bends.", "no", "yes"],
    ]
    anchors = Parsed(html).every("id")
    order = ["what", "outcome", "claims", "scores", "correlations", "figures", "assumptions"]
    assert [anchor for anchor in anchors if anchor in order] == order
    assert html.count("Seen.") == len(made)


def test_assumptions_of_the_model_stand_beside_those_of_a_device_called_config(
    results: Results, tmp_path: Path
) -> None:
    *others, last = results.scenes
    renamed = dataclasses.replace(last, device=dataclasses.replace(last.device, name="config"))
    rows = [tuple(row | {"device": "config"} if row["device"] == "device3" else row for row in table)
            for table in (results.scores, results.correlations)]  # fmt: skip
    page = report(
        TEMPLATE.read_text(encoding="utf-8"),
        dataclasses.replace(results, scenes=(*others, renamed), scores=rows[0], correlations=rows[1]),
        CLAIMS,
        quantities(read_yaml(CONFIG)),
        {"device2": quantities(read_yaml(DEVICES[0])), "config": quantities(read_yaml(DEVICES[1]))},
        [],
        Picture("rules", Words("Rules", "Boxes.", "n = 2 rules."), ""),
        provenance(ROOT / "pyproject.toml", "0123abc", [CONFIG, *DEVICES]),
    )
    headings = re.findall("<h3>(.*?)</h3>", page)
    assert [name for name in headings if name in ("The model", *(scene.device.title for scene in results.scenes))] == [
        "The model", *(scene.device.title for scene in results.scenes)
    ]  # fmt: skip


def test_every_caption_carries_its_count(results: Results) -> None:
    for said in words(FIGURES, results).values():
        assert re.search(r"n = \d|\d conditions", said.caption), said


def test_each_rule_of_the_graph_counts_once() -> None:
    waits = [("mesh", "solve"), ("mesh", "score"), ("solve", "score")]
    graph = [{"rule": rule, "feeds": other} for rule, other in waits]
    assert "n = 3 rules" in rules_words(graph).caption


def test_figures_come_in_reading_order(results: Results) -> None:
    assert list(words(FIGURES, results))[:2] == ["section", "figure_3_workflow"]
    assert list(words(FIGURES, results))[-1] == "map_small_device3-alternate"


def test_captions_explain_the_range_where_there_is_one(results: Results) -> None:
    said = "R² range: over all ratings"
    unordered = tuple(row | {"r2_lowest": "", "r2_highest": ""} for row in results.correlations)
    without = dataclasses.replace(results, correlations=unordered)
    assert said in words(["figure_6_shear"], results)["figure_6_shear"].caption
    assert said not in words(["figure_6_shear"], without)["figure_6_shear"].caption
    opened = tuple(row | {"range_open": "1"} for row in results.correlations)
    told = words(["figure_6_shear"], dataclasses.replace(results, correlations=opened))["figure_6_shear"].caption
    assert "0.75, open, " in told
    assert OPEN_SLOPE in told
    assert OPEN_SLOPE not in words(["figure_6_shear"], results)["figure_6_shear"].caption


def test_a_map_names_the_conditions_of_its_dispersion_alone(results: Results) -> None:
    *others, last = results.scenes
    first, *rest = last.device.conditions
    device = dataclasses.replace(last.device, conditions=(dataclasses.replace(first, dispersion="low"), *rest))
    two = dataclasses.replace(results, scenes=(*others, dataclasses.replace(last, device=device)))
    low, other = words(["map_small_device3-low", "map_small_device3-alternate"], two).values()
    assert first.name in low.caption and first.name not in other.caption  # it is not called by its dispersion and phase
    assert all(one.name in other.caption and one.name not in low.caption for one in rest)
    assert "low dispersion" in low.heading and "alternate dispersion" in other.heading
    (alone,) = words(["map_small_device3-alternate"], results).values()
    assert "dispersion" not in alone.heading  # there is but one


def test_a_map_says_what_its_rows_and_colours_are(results: Results) -> None:
    (said,) = words(["map_small_device3-alternate"], results).values()
    for told in (
        "Small strain, with shear",
        "maximum principal strain (%)",
        "change from the pre-indented state (%)",
        "traction on the skin (kPa)",
        "drawn to scale",
        "clipped",
        f"{COVERED:g} % is strained less",
    ):
        assert told in said.caption, told


def test_captions_of_figures_that_are_drawn_twice_begin_with_their_kinematics(results: Results) -> None:
    finite = [tuple(row | {"kinematics": "finite"} for row in rows) for rows in (results.scores, results.correlations)]
    both = dataclasses.replace(
        results, scores=(*results.scores, *finite[0]), correlations=(*results.correlations, *finite[1])
    )
    stems = ["figure_4_receptors", "figure_5_correlation", "figure_6_shear", "ablation_shear"]
    for stem in stems:
        small, other = words([stem, f"{stem}_finite"], both).values()
        assert small.caption.startswith("Small strain. ") and other.caption.startswith("Finite strain. ")
        assert small.heading != other.heading


def test_the_caption_of_kinematics_says_what_panels_show_and_leaves_numbers_to_the_table(results: Results) -> None:
    (said,) = words(["kinematics"], results).values()
    assert "indentation from first touch (mm)" in said.caption and "(N/mm)" in said.caption
    assert "±" not in said.caption


def test_devices_without_a_lateral_one_have_captions(results: Results) -> None:
    """Figure 3 shows any device, then; there is no figure 6."""
    stems = [stem for stem in FIGURES if stem != "figure_6_shear"]
    found = words(stems, dataclasses.replace(results, example="device3"))
    assert set(found) == set(stems)
    assert "Device 3" in found["figure_3_workflow"].heading


def test_captions_of_finite_figures_name_the_devices_that_they_show(results: Results) -> None:
    """Device 2 leaves finite strain out: captions say nothing of it, nor of finite scores beside its small ones."""
    first, *others = results.scenes
    alone = dataclasses.replace(first, device=dataclasses.replace(first.device, kinematics=(Kinematics.SMALL,)))
    finite = [row | {"kinematics": "finite"} for rows in (results.scores, results.correlations) for row in rows]
    scores, correlations = finite[: len(results.scores)], finite[len(results.scores) :]
    both = dataclasses.replace(
        results,
        scenes=(alone, *others),
        scores=(*results.scores, *(row for row in scores if row["device"] != first.device.name)),
        correlations=(*results.correlations, *(row for row in correlations if row["device"] != first.device.name)),
    )
    stems = ["figure_4_receptors_finite", "figure_5_correlation_finite", "ablation_shear_finite", "kinematics"]
    *captions, beside = (said.caption for said in words(stems, both).values())
    for caption in captions:
        assert first.device.title not in caption
        assert all(scene.device.title in caption for scene in others)
    assert f"{first.device.title} (n = 3 conditions, small strain alone)" in beside
    assert beside.count("alone") == 1


def test_captions_take_numbers_from_the_rows_that_their_figures_show(results: Results) -> None:
    """All scores and correlations differ from one another, and finite ones from small ones."""
    small = [row | {"score": row["score"] and str(0.1 + 0.01 * n)} for n, row in enumerate(results.scores)]
    finite = [row | {"kinematics": "finite", "score": row["score"] and str(float(row["score"]) + 1.0)} for row in small]
    related = tuple(
        row | {"r2": row["r2"] and str(0.1 + 0.01 * n), "r2_lowest": row["r2"] and str(0.01 * n)}
        for n, row in enumerate(results.correlations)
    )
    both = dataclasses.replace(results, scores=(*small, *finite), correlations=related)
    said = words(FIGURES, both)
    change = Readout.CHANGE_OF_STRAIN
    for row in filter(lambda row: row["score"], both.scores):
        told = f"{float(row['phase_deg']):g}°: {score_with_error(row)}"
        is_small, is_shear = row["kinematics"] == "small", row["interface"] == "shear"
        first, is_change = row["device"] == "device2", row["readout"] == change
        assert (told in said["figure_3_workflow"].caption) is (is_small and is_shear and first)
        assert (told in said["map_small_device3-alternate"].caption) is (
            is_small and is_shear and is_change and not first
        )
    gabor = results.scenes[0].model.gabor
    assert f"Strain (λ = {gabor.wavelength_strain:g} mm" in said["figure_3_workflow"].caption
    assert f"Change of strain (λ = {gabor.wavelength_change:g} mm" in said["figure_3_workflow"].caption
    for row in filter(lambda row: row["r2"], related):
        told = f"{SURROGATE} = {r2_text(row)}"
        assert (told in said["figure_5_correlation"].caption) is (row["interface"] == "shear")
        lowest = f"{INTERFACE_NAME[Interface(row['interface'])]} falling, R² range {float(row['r2_lowest']):.2f} to"
        assert (lowest in said["ablation_shear"].caption) is (row["readout"] == change)
    assert f"Receptors lie {results.scenes[0].model.receptor_depth:g} mm below" in said["section"].caption


def test_accuracy_is_in_per_cent_of_each_score(results: Results) -> None:
    """Errors of 1, 2 and 6 % have the median 2 %."""
    rows = [row | {"score": "0.5", "score_error": error} for row, error in
            zip(results.scores[::2], ("0.005", "0.01", "0.03"), strict=False)]  # fmt: skip
    (body,) = accuracy_grid(rows, {"device2": "Device 2"}).bodies
    assert [cell for _, cells in body.rows for cell in cells if cell[0].isdigit()] == ["1.00", "2.00", "6.00"]
    assert "the median stated error is 2.00 %, the largest 6.00 %" in accuracy_summary(rows)


def test_figure_without_a_caption_is_an_error(results: Results) -> None:
    with pytest.raises(KeyError, match="map_small_device3-high"):
        words(["section", "map_small_device3-high"], results)


@pytest.mark.parametrize(
    ("readout", "score", "error", "text"),
    [
        ("strain", "0.324622", "0.000654", "0.3246 ± 0.0007"),
        ("change_of_strain", "0.001977", "0.000033", "1.98 ± 0.03"),
        ("strain", "0.5", "0.0", "0.5 ± 0"),
        ("strain", "0.324622", "", "0.3246 ± ?"),
    ],
)
def test_score_ends_where_its_error_does(readout: str, score: str, error: str, text: str) -> None:
    assert score_with_error({"readout": readout, "score": score, "score_error": error}) == text


def test_small_p_is_a_bound() -> None:
    assert p_text("0.0005").startswith("<")
    assert p_text("0.0493") == "0.049"
    assert p_text("0.2") == "0.20"


def test_devices_that_come_in_parts_are_one_body(results: Results) -> None:
    titles = {scene.device.name: scene.device.title for scene in results.scenes}
    grid = score_grid(results.scores, titles)
    assert [body.title for body in grid.bodies] == list(titles.values())
    assert all(len(cells) == 4 for body in grid.bodies for _, cells in body.rows)


def test_correlations_without_a_prediction_stand_with_their_device(results: Results) -> None:
    titles = {scene.device.name: scene.device.title for scene in results.scenes}
    listing = correlation_listing(results.correlations, titles)
    assert len({body.title for body in listing.bodies}) == len(listing.bodies)
    assert sum(len(body.rows) for body in listing.bodies) == len(results.correlations)
    assert all(len(cells) + 1 == len(listing.columns) for body in listing.bodies for _, cells in body.rows)


def test_a_column_in_which_nothing_stands_is_left_out(results: Results) -> None:
    """As p of surrogate ratings; measured ones have it."""
    titles = {scene.device.name: scene.device.title for scene in results.scenes}
    measured = [{**row, "rating_kind": RatingKind.MEASURED.label} for row in results.correlations]
    columns = [correlation_listing(rows, titles).columns for rows in (results.correlations, measured)]
    assert set(columns[1]) - set(columns[0]) == {"p of R²"}
    assert "n" in columns[0]


def test_notes_of_scores_stand_once_with_all_that_they_are_about(results: Results) -> None:
    """Not why there is no score: that stands in its place."""
    beware = "actuators that leave the skin: 2, 3"
    rows = [row | {"note": beware} if row["score"] and row["device"] == "device2" else row for row in results.scores]
    titles = {scene.device.name: scene.device.title for scene in results.scenes}
    ((title, about, note),) = score_notes(rows, titles)
    assert (title, note) == (titles["device2"], beware)
    conditions = ", ".join(dict.fromkeys(row["condition"] for row in rows if row["device"] == "device2"))
    assert about == "; ".join(f"{conditions} ({INTERFACE_NAME[interface]})" for interface in Interface)


def test_accuracy_counts_only_what_has_a_score(results: Results) -> None:
    assert "n = 18 scores" in accuracy_summary(results.scores)
    assert "0.28 %" in accuracy_summary(results.scores)


# Sources


def test_committed_page_of_assumptions_is_what_the_scene_files_say() -> None:
    files = [CONFIG, *sorted((ROOT / "config" / "devices").glob("device[123].yaml"))]
    package = ROOT / "src" / "fingerpad"
    modules = {
        path.relative_to(package).as_posix(): path.read_text(encoding="utf-8") for path in sorted(package.rglob("*.py"))
    }
    made = page({f"{path.parent.name}/{path.name}": read_yaml(path) for path in files}, modules)
    committed = (ROOT / "docs" / "assumptions.md").read_text(encoding="utf-8")
    assert committed == made, (
        "scene files or assumptions have changed: run `snakemake docs`, commit docs/assumptions.md"
    )


def test_every_source_of_a_scene_file_is_listed_once() -> None:
    for path in (CONFIG, *DEVICES):
        found = quantities(read_yaml(path))
        assert len(found) == len(re.findall(r"\bsource: \"", path.read_text(encoding="utf-8")))
        assert len({each.key for each in found}) == len(found)


@pytest.mark.parametrize(
    ("source", "origin", "said"),
    [
        ("assumption: a guess", Origin.ASSUMPTION, "a guess"),
        ("paper: Table 2", Origin.PAPER, "Table 2"),
        ("Seo et al. 2009: aluminium", Origin.REFERENCE, "Seo et al. 2009: aluminium"),
        ("paper", Origin.REFERENCE, "paper"),
    ],
)
def test_origin_is_the_first_word_of_a_source(source: str, origin: Origin, said: str) -> None:
    (found,) = quantities({"a": {"value": True, "unit": "1", "source": source}})
    assert (found.origin, found.source, found.value) == (origin, said, "true")


# The graph of rules


def test_graph_is_read_without_wildcards_and_styles() -> None:
    dot = 'digraph x {\n\t0[label = "all", color = "red"];\n\t1[label = "map\\ndevice: a"];\n\t1 -> 0\n}'
    assert read_dot(dot) == [("map", "all")]


def test_edges_that_others_imply_are_left_out() -> None:
    edges = [("a", "b"), ("b", "c"), ("a", "c"), ("a", "d"), ("c", "d")]
    assert reduced(edges) == [("a", "b"), ("b", "c"), ("c", "d")]


def test_every_edge_leads_down_and_no_boxes_overlap() -> None:
    edges = [("a", "b"), ("b", "c"), ("c", "z"), ("a", "x"), ("x", "z"), ("a", "y"), ("y", "z"), ("b", "z")]
    places, lines = placed(edges)
    level = layers(edges)
    assert all(level[start] < level[stop] for start, stop in edges)
    for one, (x, row) in places.items():
        for other, (x_other, row_other) in places.items():
            assert one == other or row != row_other or abs(x - x_other) >= 1.0 - 1e-9
    assert [(line[0], line[-1]) for line in lines] == [(places[start], places[stop]) for start, stop in edges]
    assert all(stop[1] == start[1] + 1 for line in lines for start, stop in pairwise(line))


def test_boxes_of_the_runs_rules_stand_apart_and_hold_their_names(tmp_path: Path) -> None:
    """Of the graph as it is: a further rule makes columns narrower, until its names no longer fit."""
    script = runpy.run_path(str(ROOT / "workflow/scripts/rule_graph.py"))
    script["main"](ROOT / "Snakefile", ROOT / "config" / "config.yaml", tmp_path / "graph.csv")
    edges = [(row["rule"], row["feeds"]) for row in read_rows(tmp_path / "graph.csv")]
    figure = rules_figure(edges)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    boxes = [patch.get_window_extent() for patch in axes.patches]
    names = [text.get_window_extent() for text in axes.texts]
    assert len(boxes) == len(names) == len({rule for edge in edges for rule in edge})
    assert not [1 for one, other in combinations(boxes, 2) if one.overlaps(other)]
    for inner, outer in [*zip(names, boxes, strict=True), *((box, axes.get_window_extent()) for box in boxes)]:
        assert outer.x0 <= inner.x0 and inner.x1 <= outer.x1 and outer.y0 <= inner.y0 and inner.y1 <= outer.y1


def test_edges_do_not_cross_where_another_order_untangles_them() -> None:
    places, _ = placed([("a", "d"), ("b", "c")])
    assert (places["a"][0] < places["b"][0]) == (places["d"][0] < places["c"][0])
