"""Scores of solved conditions under other read-outs: another measure, side of the interface or wavelength.

Contact does not know how it is read, so nothing is solved again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.stats import kendalltau, pearsonr

from ..contact.solution import Solution
from ..readouts.comparison import classes
from ..readouts.gabor import filtered_readouts
from ..readouts.measures import Measure, measured
from ..readouts.resampling import resampling_to_grid
from ..readouts.roughness import SCORE_UNIT, SERIES, score_rows
from ..readouts.strain import read_receptors
from ..scene.contact_law import Interface
from ..scene.readout import Side
from ..scene.scene import Scene
from ..tissue.compliance import CondensedSection
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh

# times a read-out's wavelength [1]; source: an octave either way, in half octaves
WAVELENGTH_FACTORS = (0.5, 0.5**0.5, 1.0, 2.0**0.5, 2.0)
VARIANT = ["measure", "side", "wavelength_factor"]  # columns of the table that say how a score was read
UNCHANGED = 1.0  # wavelength factor [1] of read-outs as configured


def on_both_sides(scene: Scene, own: CondensedSection, mesh: SectionMesh) -> dict[Side, CondensedSection]:
    """The condensed finger with receptors read on each side: as configured it is there, for the other side it is
    condensed anew. Raises what `condense_section` raises.
    """
    configured = scene.model.readout.side
    (other,) = set(Side) - {configured}
    readout = replace(scene.model.readout, side=other)
    there = condense_section(mesh, scene.with_model(readout=readout))
    return {configured: own, other: there}


def readout_rows(
    scene: Scene,
    sections: Mapping[Side, CondensedSection],
    solutions: Mapping[tuple[str, Interface], Solution],
) -> Iterator[dict[str, Any]]:
    """Rows of the score table with the columns VARIANT, for all measures, sides and wavelengths.

    sections: the condensed finger with receptors read on each side. solutions: by condition and interface. Raises
    SceneError if the device has no condition of such a name.
    """
    for side, section in sections.items():
        resampling = resampling_to_grid(section.arc, scene.model.gabor.spacing)
        for measure in Measure:
            layer = scene.model.finger.pad[scene.model.receptor_layer(side)]
            of_strain = partial(measured, measure, material=layer.material)
            for (name, interface), solution in solutions.items():
                settling = scene.device.condition(name).settling
                read = read_receptors(section.receptor_strain(solution.force), section.arc, of_strain, settling)
                for factor in WAVELENGTH_FACTORS:
                    variant = _with_wavelengths(scene, factor)
                    filtered = filtered_readouts(resampling, read.readouts, variant.model.gabor)
                    for row in score_rows(variant, scene.device.condition(name), interface, filtered):
                        unit = SCORE_UNIT if measure.unit == "1" else f"{measure.unit} {SCORE_UNIT}"
                        how = {"measure": str(measure), "side": str(side), "wavelength_factor": round(factor, 3)}
                        yield row | {"unit": unit} | how


def agreement(rows: Sequence[Mapping[str, Any]], side: Side) -> list[dict[str, Any]]:
    """How the conditions' scores under each variant agree with those as configured, a row per device, interface,
    read-out and variant.

    kendall_tau, r [1]: rank and linear correlation over the n conditions; both None where scores are constant. side: as
    configured.
    """
    found = []
    groups: dict[tuple[Any, ...], dict[tuple[Any, ...], dict[str, float]]] = {}
    for row in rows:
        variants = groups.setdefault(tuple(row[key] for key in SERIES), {})
        variants.setdefault(tuple(row[key] for key in VARIANT), {})[row["condition"]] = float(row["score"])
    for key, variants in groups.items():
        reference = variants[str(Measure.MAXIMUM_PRINCIPAL), str(side), UNCHANGED]
        usual = np.array(list(reference.values()))
        for variant, scores in variants.items():
            values = np.array([scores[condition] for condition in reference])
            ranks = classes(usual), classes(values)
            constant = not all(each.any() for each in ranks)
            row = dict(zip([*SERIES, *VARIANT], (*key, *variant), strict=True))
            row["n"] = usual.size
            row["kendall_tau"] = None if constant else float(kendalltau(*ranks).statistic)
            row["r"] = None if constant else float(pearsonr(usual, values).statistic)
            found.append(row)
    return found


def _with_wavelengths(scene: Scene, factor: float) -> Scene:
    """The scene with both wavelengths of the filter times a factor [1]."""
    gabor = scene.model.gabor
    changed = replace(
        gabor,
        wavelength_strain=factor * gabor.wavelength_strain,
        wavelength_change=factor * gabor.wavelength_change,
    )
    return scene.with_model(gabor=changed)
