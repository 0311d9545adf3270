"""Captions of the report's figures: what a figure shows, with the numbers behind it, taken from scenes and tables."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial

from ..perception.wording import (
    OPEN_SLOPE,
    SURROGATE,
    has_open,
    has_p,
    is_surrogate,
    p_text,
    r2_text,
    range_text,
    slope_name,
    tau_text,
)
from ..scene.contact_law import Interface
from ..scene.device import Device
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.stimuli import condition_name
from ..scene.tissue_law import Kinematics
from ..words import (
    CHANGE_COVERED,
    COVERED,
    INTERFACE_NAME,
    KINEMATICS_NAME,
    MODE_ENDING,
    READOUT_NAME,
    SCORE_SCALE,
    counted,
    plain,
    several,
    typeset,
)
from .tables import Row, score_with_error

SIGMA = "\N{GREEK SMALL LETTER SIGMA}"
ERROR_BARS = "Bars: estimated discretisation error of a score."
ERROR_LINES = "Lines on bars: estimated discretisation error of a score."


@dataclass(frozen=True)
class Results:
    """What captions are written from: the scenes, rows of scores.csv and of correlations.csv, and the name of the
    device that figures of one device show.
    """

    scenes: tuple[Scene, ...]
    scores: tuple[Row, ...]
    correlations: tuple[Row, ...]
    example: str

    def device(self, name: str) -> Device:
        """The device of that name. Raises KeyError if there is none."""
        return {scene.device.name: scene.device for scene in self.scenes}[name]


@dataclass(frozen=True)
class Words:
    """What is said of a figure: heading, text for those who do not see it, and caption."""

    heading: str
    alternative: str
    caption: str


def words(stems: Collection[str], results: Results) -> dict[str, Words]:
    """What is said of the figures with these file stems, in the order in which they are read.

    Raises KeyError if nothing is written of one of them.
    """
    small, finite = (_of(results, kinematics) for kinematics in Kinematics)
    writers: dict[str, Callable[[], Words]] = {stem: partial(write, small) for stem, write in _ONCE.items()}
    for stem, write in _WITH_KINEMATICS.items():
        for kinematics, own in zip(Kinematics, (small, finite), strict=True):
            writers[f"{stem}{MODE_ENDING[kinematics]}"] = partial(_with_kinematics, write, own, kinematics)
    writers["kinematics"] = partial(_kinematics, results)
    for scene in results.scenes:
        for dispersion in scene.device.by_dispersion:
            stem = f"map_{Kinematics.SMALL}_{scene.device.name}-{dispersion}"
            writers[stem] = partial(_map, small, device=scene.device, dispersion=dispersion)
    if unknown := set(stems) - set(writers):
        raise KeyError(f"no caption for {', '.join(sorted(unknown))}")
    return {stem: write() for stem, write in writers.items() if stem in stems}


def _of(results: Results, kinematics: Kinematics) -> Results:
    """Results with those kinematics alone, of the devices that are predicted with them."""
    scenes = tuple(scene for scene in results.scenes if kinematics in scene.computed)
    scores, correlations = (
        tuple(row for row in rows if row["kinematics"] == kinematics) for rows in (results.scores, results.correlations)
    )
    return replace(results, scenes=scenes, scores=scores, correlations=correlations)


def _with_kinematics(write: Callable[[Results], Words], results: Results, kinematics: Kinematics) -> Words:
    """What is said of a figure that is drawn for all kinematics, and of which ones this is."""
    said = write(results)
    ending = f", {KINEMATICS_NAME[kinematics]}" if kinematics is Kinematics.FINITE else ""
    caption = f"{KINEMATICS_NAME[kinematics].capitalize()}. {said.caption}"
    return replace(said, heading=f"{said.heading}{ending}", caption=caption)


def rules_words(graph: Sequence[Row]) -> Words:
    """What is said of the figure of the run's rules. graph: rows of rule_graph.csv."""
    names = {row[end] for row in graph for end in ("rule", "feeds")}
    return Words(
        "The run's rules",
        "Boxes of rules, joined by lines from each rule to those that wait for it.",
        f"What made this page (“snakemake report”): n = {len(names)} rules, each of which waits for those above it"
        " that a line joins to it. A rule may run once for each device, condition and interface; waits that others"
        " imply are left out.",
    )


def _correlation_words(row: Row) -> str:
    """One row of the table of correlations as a phrase. R² comes last where it is that of surrogates."""
    if not row["r2"]:
        return f"{row['note']}, n = {row['n']}" if row["n"] != "0" else row["note"]
    p = f", p over distinct conditions {p_text(row['p'])}" if has_p(row["p"], row["rating_kind"]) else ""
    order = f"τ = {tau_text(row)}, {slope_name(row)}"
    if is_surrogate(row):
        return f"{order}{_range_of(row)}, {SURROGATE} = {r2_text(row)}, n = {row['n']}"
    return f"R² = {r2_text(row)}{p}{_range_of(row)}, {order}, n = {row['n']}"


def _range_of(row: Row) -> str:
    """The range of R², if the order of the ratings is stated."""
    return f", R² range {range_text(row)}" if range_text(row) else ""


def _section(results: Results) -> Words:
    model = results.scenes[0].model
    layers = ", ".join(f"{plain(layer.name)} {layer.thickness:g} mm" for layer in model.finger.pad)
    rows = "; ".join(
        f"{device.title}: {several(len(row.positions), 'actuator')} {row.width:g} mm wide"
        for device, row in ((scene.device, scene.device.actuators) for scene in results.scenes)
    )
    return Words(
        "The finger's section and the devices",
        "Cross-section of the fingertip with its layers, bone and nail, and the actuators of each device below it.",
        f"Section {model.finger.width:g} mm wide and {model.finger.height:g} mm high."
        f" Pad on the mid-line, from the skin inwards: {layers}."
        f" Receptors lie {model.receptor_depth:g} mm below the skin."
        f" n = {several(len(results.scenes), 'device')}. {rows}.",
    )


def _stimuli(results: Results) -> Words:
    counts = "; ".join(f"{scene.device.title}: {counted(scene.device.conditions)}" for scene in results.scenes)
    return Words(
        "Stimuli",
        "Bars: how far every actuator moves in every condition of each device.",
        f"Displacements (µm) from the pre-indented position, actuators from left to right. {counts}.",
    )


def _workflow(results: Results) -> Words:
    device, gabor = results.device(results.example), results.scenes[0].model.gabor
    scores = ". ".join(
        f"{READOUT_NAME[readout]} (λ = {gabor.wavelength(readout):g} mm, {SIGMA} = {gabor.sigma:g} mm):"
        f" {_scores(results, device.name, Interface.SHEAR, readout)}"
        for readout in Readout
    )
    return Words(
        f"From strain to score: {device.title}",
        "Strain and change of strain along the receptor line, the same Gabor-filtered, and bars of their areas.",
        f"{KINEMATICS_NAME[Kinematics.SMALL].capitalize()}, with shear, {counted(device.conditions)}. Grey line: the"
        f" pre-indented state, from which strain changes. Scores: {scores}.",
    )


def _receptors(results: Results) -> Words:
    counts = "; ".join(
        f"{scene.device.title}: {counted(scene.device.conditions)}, {len(scene.device.distinct_conditions)} distinct"
        for scene in results.scenes
    )
    return Words(
        "Strain and change of strain at the receptors",
        "Curves of strain (left) and change of strain (right) along the receptors, one row per device and dispersion.",
        "With shear. Maximum principal strain (left, %) and its change from the pre-indented state (right, %) over arc"
        f" length along the receptors (mm). Grey line: the pre-indented state. {counts}. Shaded: under a face before"
        " the stimulus.",
    )


def _correlation(results: Results) -> Words:
    parts = "; ".join(_correlated(results, scene.device.name, Interface.SHEAR) for scene in results.scenes)
    return Words(
        "Scores against perceived roughness",
        "Perceived roughness over the strain score (left) and the change-of-strain score (right), one row per device.",
        f"With shear. {parts}.{_range(results)} Ratings: {_kinds(results)}. {ERROR_BARS}",
    )


def _shear(results: Results) -> Words:
    device = results.device(results.example)
    own = tuple(row for row in results.correlations if row["device"] == device.name)
    results = replace(results, correlations=own)
    parts = "; ".join(
        f"{INTERFACE_NAME[interface]}, {_correlated(results, device.name, interface, titled=False)}"
        for interface in reversed(Interface)
    )
    return Words(
        f"With and without shear: {device.title}",
        "Perceived roughness over strain score (top) and change-of-strain score (bottom), without and with shear.",
        f"The same {len(device.conditions)} conditions: {parts}.{_range(results)} Ratings: {_kinds(results)}."
        f" {ERROR_BARS}",
    )


def _ablation(results: Results) -> Words:
    parts = []
    for scene in results.scenes:
        found = [
            f"{INTERFACE_NAME[interface]} {_r2(row)}"
            for interface in Interface
            for row in _rows(results, scene.device.name, interface)
            if row["readout"] == Readout.CHANGE_OF_STRAIN
        ]
        parts.append(f"{scene.device.title} ({counted(scene.device.conditions)}): {', '.join(found)}")
    return Words(
        "Every score with and without shear",
        "Bars of strain scores (left) and change-of-strain scores (right) of every condition, with and without shear.",
        f"How scores of the change of strain correlate: {'; '.join(parts)}. Ratings:"
        f" {_kinds(results)}.{_range(results, with_tau=False)} {ERROR_LINES}",
    )


def _kinematics(results: Results) -> Words:
    parts = []
    for scene in results.scenes:
        alone = "" if len(scene.computed) > 1 else f", {KINEMATICS_NAME[scene.computed[0]]} alone"
        parts.append(f"{scene.device.title} ({counted(scene.device.conditions)}{alone})")
    both = " and ".join(KINEMATICS_NAME[each] for each in Kinematics)
    return Words(
        "Small and finite strain side by side",
        "Force against indentation (left), bars of strain scores (middle) and change-of-strain scores (right).",
        f"{both.capitalize()}; a row per device: {'; '.join(parts)}. Left: force of all actuators per mm of finger"
        " (N/mm) against indentation from first touch (mm), with shear (full lines) and without (dotted); marks show"
        " where pre-indentation ends and stimuli begin. Middle and right: scores of strain and of its change with"
        f" shear, each on its own scale. {ERROR_LINES} Numbers are in the table of scores.",
    )


def _map(results: Results, device: Device, dispersion: str) -> Words:
    chosen = device.by_dispersion[dispersion]
    shown = _scores(results, device.name, Interface.SHEAR, Readout.CHANGE_OF_STRAIN, [one.name for one in chosen])
    named = f", {plain(dispersion)} dispersion" if len(device.by_dispersion) > 1 else ""
    when = "when receptors are read" if any(one.time.size > 1 for one in chosen) else "at the end of the stimulus"
    return Words(
        f"Strain in the section: {device.title}{named}",
        "Colour maps of the maximum principal strain in the deformed section and of its change; tractions on the skin.",
        f"{KINEMATICS_NAME[Kinematics.SMALL].capitalize()}, with shear, {when}; a column per condition,"
        f" {counted(chosen)}. Top: maximum principal strain (%). Middle: its change from the pre-indented state (%), at"
        " the same points of tissue. Bottom: contact pressure and shear traction on the skin (kPa). Displacements are"
        " drawn to scale. Colours are common to all maps of the device, and clipped where bars end in a point: of the"
        f" area in view {COVERED:g} % is strained less; {CHANGE_COVERED:g} % changes less, and so do all receptors."
        f" Dashed: the receptors. Change-of-strain scores: {shown}.",
    )


_ONCE: dict[str, Callable[[Results], Words]] = {
    "section": _section,
    "stimuli": _stimuli,
    "figure_3_workflow": _workflow,
}
_WITH_KINEMATICS: dict[str, Callable[[Results], Words]] = {
    "figure_4_receptors": _receptors,
    "figure_5_correlation": _correlation,
    "figure_6_shear": _shear,
    "ablation_shear": _ablation,
}


def _scores(
    results: Results, device: str, interface: Interface, readout: Readout, names: Sequence[str] | None = None
) -> str:
    """Scores with errors of one device, interface and read-out, of all conditions or some."""
    rows = [
        row
        for row in results.scores
        if (row["device"], row["interface"], row["readout"]) == (device, interface, readout)
        and (names is None or row["condition"] in names)
        and row["score"]
    ]
    labels = _labels(results.device(device))
    found = (f"{labels[row['condition']]}: {score_with_error(row)}" for row in rows)
    unit = rows[0]["unit"] if rows else ""
    scaled = f"{SCORE_SCALE[readout][1]}{typeset(unit)}".replace(" ", "\N{NO-BREAK SPACE}")
    return f"{', '.join(found)} {scaled}"


def _labels(device: Device) -> dict[str, str]:
    """What conditions are called: their phases, after their dispersions if there are several; or their names, where
    these say more.
    """
    own = device.conditions
    if any(one.name != condition_name(one.dispersion, one.phase_deg) for one in own):
        return {one.name: one.name for one in own}
    several_spreads = len(device.by_dispersion) > 1
    return {
        one.name: f"{plain(one.dispersion)} {one.phase_deg:g}°" if several_spreads else f"{one.phase_deg:g}°"
        for one in own
    }


def _rows(results: Results, device: str, interface: Interface) -> list[Row]:
    return [row for row in results.correlations if (row["device"], row["interface"]) == (device, interface)]


def _correlated(results: Results, device: str, interface: Interface, titled: bool = True) -> str:
    found = "; ".join(
        f"{READOUT_NAME[Readout(row['readout'])].lower()}: {_correlation_words(row)}"
        for row in _rows(results, device, interface)
    )
    return f"{results.device(device).title}, {found}" if titled else found


def _r2(row: Row) -> str:
    if not row["r2"]:
        return f"({row['note']})"
    if is_surrogate(row):
        return f"{slope_name(row)}{_range_of(row) or f', {SURROGATE} = {r2_text(row)}'}"
    return f"R² = {r2_text(row)}{_range_of(row)}, {slope_name(row)}"


def _range(results: Results, with_tau: bool = True) -> str:
    """What ranges of R² and of τ are, where there are any."""
    rows = results.correlations
    has_ranges = any(row["r2_lowest"] for row in rows)
    has_between = with_tau and any(row["tau_lowest"] != row["tau_highest"] for row in rows)
    told = " R² range: over all ratings with the stated order, without errors of scores." if has_ranges else ""
    told += " In brackets: from where to where errors of scores leave τ." if has_between else ""
    return told + (f" {OPEN_SLOPE}" if has_open(rows) else "")


def _kinds(results: Results) -> str:
    kinds = dict.fromkeys(row["rating_kind"] for row in results.correlations if row["rating_kind"])
    return ", ".join(kinds) or "none"
