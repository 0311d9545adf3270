"""Captions of the report's figures: what a figure shows, with the numbers behind it, taken from scenes and tables."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial

from ..perception.wording import (
    OPEN_SLOPE,
    has_open,
    has_p,
    p_text,
    range_text,
    slope_name,
    tau_text,
)
from ..scene.contact_law import Interface
from ..scene.device import Device
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..words import (
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
    writers: dict[str, Callable[[], Words]] = {}
    for stem, write in _WRITERS.items():
        writers[stem] = partial(write, small)
        writers[f"{stem}{MODE_ENDING[Kinematics.FINITE]}"] = partial(_finite, write, finite)
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


def _finite(write: Callable[[Results], Words], results: Results) -> Words:
    """What is said of the same figure with finite kinematics."""
    said = write(results)
    return replace(said, heading=f"{said.heading}, finite strain", caption=f"Finite kinematics. {said.caption}")


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
    """One row of the table of correlations as a phrase: R² with its p, range and slope, tau and n."""
    if not row["r2"]:
        return f"{row['note']}, n = {row['n']}" if row["n"] != "0" else row["note"]
    p = f", p over distinct conditions {p_text(row['p'])}" if has_p(row["p"], row["rating_kind"]) else ""
    tau = tau_text(row)
    return f"R² = {float(row['r2']):.3f}{p}{_spread(row)}, {slope_name(row)}, τ = {tau}, n = {row['n']}"


def _spread(row: Row) -> str:
    """The range of R² in brackets, if the order of the ratings is stated."""
    return f" ({range_text(row)})" if range_text(row) else ""


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
        f"Displacements from the pre-indented position, actuators from left to right. {counts}.",
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
        f"With shear, small strain, {counted(device.conditions)}. Scores: {scores}.",
    )


def _receptors(results: Results) -> Words:
    counts = "; ".join(
        f"{scene.device.title}: {counted(scene.device.conditions)}, {len(scene.device.distinct_conditions)} distinct"
        for scene in results.scenes
    )
    return Words(
        "Strain and change of strain at the receptors",
        "Curves of strain (left) and change of strain (right) along the receptors, one row per device and dispersion.",
        f"Maximum principal strain and its change from pre-indentation, with shear. {counts}."
        " Grey: under a face before the stimulus.",
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
        f"R² of the change of strain: {'; '.join(parts)}. Ratings: {_kinds(results)}.{_range(results, with_tau=False)}"
        f" {ERROR_LINES}",
    )


def _kinematics(results: Results) -> Words:
    parts = []
    for scene in results.scenes:
        key = scene.device.name, Interface.SHEAR, Readout.CHANGE_OF_STRAIN
        shown = [f"{KINEMATICS_NAME[each]} {_scores(_of(results, each), *key)}" for each in scene.computed]
        parts.append(f"{scene.device.title} ({counted(scene.device.conditions)}): {'; '.join(shown)}")
    return Words(
        "Small and finite strain side by side",
        "Force against indentation (left), bars of strain scores (middle) and change-of-strain scores (right).",
        f"Scores of the change of strain with shear. {'. '.join(parts)}. {ERROR_LINES}",
    )


def _map(results: Results, device: Device, dispersion: str) -> Words:
    chosen = device.by_dispersion[dispersion]
    shown = _scores(results, device.name, Interface.SHEAR, Readout.CHANGE_OF_STRAIN, [one.name for one in chosen])
    return Words(
        f"Strain in the section: {device.title}, {plain(dispersion)} dispersion",
        "Colour maps of the maximum principal strain in the deformed section and of its change; tractions on the skin.",
        f"With shear, {counted(chosen)}. Change-of-strain scores: {shown}.",
    )


_WRITERS: dict[str, Callable[[Results], Words]] = {
    "section": _section,
    "stimuli": _stimuli,
    "figure_3_workflow": _workflow,
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
    found = (f"{row['condition']} {score_with_error(row)}" for row in rows)
    unit = rows[0]["unit"] if rows else ""
    scaled = f"{SCORE_SCALE[readout][1]}{typeset(unit)}".replace(" ", "\N{NO-BREAK SPACE}")
    return f"{', '.join(found)} {scaled}"


def _rows(results: Results, device: str, interface: Interface) -> list[Row]:
    return [row for row in results.correlations if (row["device"], row["interface"]) == (device, interface)]


def _correlated(results: Results, device: str, interface: Interface, titled: bool = True) -> str:
    found = "; ".join(
        f"{READOUT_NAME[Readout(row['readout'])].lower()}: {_correlation_words(row)}"
        for row in _rows(results, device, interface)
    )
    return f"{results.device(device).title}, {found}" if titled else found


def _r2(row: Row) -> str:
    return f"{float(row['r2']):.3f}{_spread(row)}, {slope_name(row)}" if row["r2"] else f"({row['note']})"


def _range(results: Results, with_tau: bool = True) -> str:
    """What stands in brackets behind R² and, if it is there, τ, where there is anything."""
    ranges = {
        "the range of R² over all ratings with the stated order, without errors of scores": any(
            row["r2_lowest"] for row in results.correlations
        ),
        "from where to where errors of scores leave τ": with_tau
        and any(row["tau_lowest"] != row["tau_highest"] for row in results.correlations),
    }
    told = [what for what, is_there in ranges.items() if is_there]
    opened = f" {OPEN_SLOPE}" if has_open(results.correlations) else ""
    return (f" In brackets {', and '.join(told)}." if told else "") + opened


def _kinds(results: Results) -> str:
    kinds = dict.fromkeys(row["rating_kind"] for row in results.correlations if row["rating_kind"])
    return ", ".join(kinds) or "none"
