"""Condensation of tissue that creeps: a few more small dense maps, one for each time in which it does.

Under contact forces exp(s t) the tissue's compliance and strain map are those of an elastic one whose moduli are
phi(s) times the relaxed ones (`viscoelasticity`; correspondence principle). Between s = 0 and infinity they fall from
relaxed to instantaneous ones, and
    C(s) = C_g + sum of C_k / (1 + s t_k),        E(s) = E_g + sum of E_k / (1 + s t_k)
hold closely with the times t_k within the bands from relaxation to retardation times, where alone the tissue creeps.
The C_k, E_k are found from as many real s, each a condensation as any other, and checked at two more.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray
from ..errors import CondensationError
from ..scene.scene import Scene
from ..scene.vibration_rule import Relaxation
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh
from .viscoelasticity import retardation_times, stiffening

IN_BAND = 2  # times t_k [1] in each band, to begin with; source: maps as shipped then hold to 3e-5 (measured)
MOST_IN_BAND = 6  # times t_k [1] in each band; source: 4 serve where a single share of 0.9 relaxes (measured)
BEYOND = 3.0  # times [1] the end of the outermost bands; source: there maps are off most, of 25 rates (measured)
MISFIT_LIMIT = 1e-3  # of the largest entry [1]; source: a fifth of the score error that is aimed at (0.5 %)


@dataclass(frozen=True)
class Creep:
    """What creeps, of `CondensedSection`: relaxed maps are instantaneous ones and all of these together.

    time: (k,) [s]. compliance: (k, 2n, 2n) [mm per N/mm]. strain: (k, 3m, 2n) [1 per N/mm].
    """

    time: FloatArray
    compliance: FloatArray
    strain: FloatArray


def condense_creep(section: SectionMesh, scene: Scene) -> Creep:
    """Condense tissue that creeps, with so many times in each band that the maps hold to MISFIT_LIMIT beyond all bands,
    where they are off most. Raises what `condense_section` raises, and CondensationError if MOST_IN_BAND times are too
    few.
    """
    for in_band in range(IN_BAND, MOST_IN_BAND + 1):
        times = creep_times(scene.model.vibration.relaxation, in_band)
        creep, misfit = _found(section, scene, times, np.array([1.0 / (BEYOND * times[-1]), BEYOND / times[0]]))
        if misfit <= MISFIT_LIMIT:
            return creep
    raise CondensationError(
        f"{scene.device.name}: the creep of tissue could not be condensed: maps are off by {misfit:.1e} >"
        f" {MISFIT_LIMIT:.0e}; try smaller vibration.shares, or more of them at vibration.times in between"
    )


def _found(section: SectionMesh, scene: Scene, times: FloatArray, checked: FloatArray) -> tuple[Creep, float]:
    """The creep with those times (k,) [s], and by how much [1] of the largest entry its maps are off at the rates
    `checked` (c,) [1/s].
    """
    rates = np.array([0.0, *(1.0 / np.sqrt(times[1:] * times[:-1])), np.inf])
    found = [condense_section(section, stiffened(scene, rate)) for rate in rates]
    try:
        inverse = np.linalg.inv(_shares(rates, times))
    except np.linalg.LinAlgError as error:
        raise CondensationError(
            f"{scene.device.name}: vibration.shares: one is too small to be told from none, or two vibration.times are"
            " too close"
        ) from error
    compliance, strain = (
        np.tensordot(inverse, np.array(maps), 1)
        for maps in ([each.compliance for each in found], [each.strain for each in found])
    )
    misfit = 0.0
    for rate, shares in zip(checked, _shares(checked, times), strict=True):
        there = condense_section(section, stiffened(scene, float(rate)))
        for maps, exact in ((compliance, there.compliance), (strain, there.strain)):
            misfit = max(misfit, float(np.abs(np.tensordot(shares, maps, 1) - exact).max() / np.abs(exact).max()))
    return Creep(times, compliance[1:], strain[1:]), misfit


def _shares(rates: FloatArray, times: FloatArray) -> FloatArray:
    """Shares (k, 1 + n) [1] of instantaneous maps and of those of each time (n,) [s] at rates (k,) [1/s]."""
    return np.array([np.ones(rates.size), *(answer(rates, time) for time in times)]).T


def creep_times(relaxation: Relaxation, in_band: int) -> FloatArray:
    """Times t_k (k,) [s], ascending: so many in each band, evenly in their logarithm, the band's end among them."""
    bands = zip(np.sort(relaxation.times), retardation_times(relaxation), strict=True)
    return np.concatenate([np.geomspace(start, stop, in_band + 1)[1:] for start, stop in bands])


def answer(rate: FloatArray, time: float) -> FloatArray:
    """What has crept (k,) [1] of all that will, at rates (k,) [1/s]: 1 / (1 + s t)."""
    return 1.0 / (1.0 + rate * time)


def stiffened(scene: Scene, rate: complex) -> Scene:
    """The scene with layers as stiff as they are at a rate [1/s]; of a complex modulus the real part."""
    relaxation, finger = scene.model.vibration.relaxation, scene.model.finger
    factor = stiffening(relaxation, rate).real
    pad, dorsal = (
        tuple(
            replace(layer, material=replace(layer.material, modulus=factor * layer.material.modulus))
            if layer.name in relaxation.layers
            else layer
            for layer in layers
        )
        for layers in (finger.pad, finger.dorsal)
    )
    return scene.with_model(finger=replace(finger, pad=pad, dorsal=dorsal))
