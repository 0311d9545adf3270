"""`fingerpad export`: a condition as an input deck for Abaqus or CalculiX."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from threadpoolctl import threadpool_limits

from ..calculix.case import PRESSURE_SLOPE, REST_INCREMENTS, STICK_SLOPE, STIMULUS_INCREMENTS
from ..calculix.deck import DeckSettings, input_deck, kinematics_told
from ..calculix.height import indented_height
from ..files import write_text
from ..prediction.edges import mesh_device
from ..scene.contact_law import FrictionFrom
from .options import add_case_options, add_scene_options, checked_case, writable
from .progress import progress

DECK = ".inp"
STEPS = 2  # of the progress: mesh, pre-indentation
INDENTATION_INCREMENTS = 20  # [1]; source: chosen; the cases in workflow/rules/calculix.smk say what others do
DESCRIPTION = """\
Write one condition of a device as an input deck in Abaqus keywords, which CalculiX runs unchanged. Pre-indentation goes
as deep as fingerpad's own. With finite kinematics, what is printed says for which of the two programs a law is meant.

example:
  fingerpad export config/devices/device2.yaml --condition alternate_090 --interface shear -o scene.inp
  ccx -i scene
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_case_options(parser, "small strains, or large ones (NLGEOM) with the config's tissue law")
    parser.add_argument("-o", "--output", required=True, type=Path, metavar="FILE", help="deck to write")
    add_scene_options(parser)
    parser.add_argument(
        "--friction-from",
        choices=list(FrictionFrom),
        help="from when on friction acts; 'stimulus' presses without and converges better (default: the config's)",
    )
    for flag, default, what in (
        ("--pressure-slope", PRESSURE_SLOPE, "pressure over penetration [MPa/mm]"),
        ("--stick-slope", STICK_SLOPE, "shear over elastic slip [MPa/mm]"),
    ):
        parser.add_argument(flag, type=float, default=default, metavar="NUMBER", help=f"{what} (default: %(default)g)")
    for flag, increments, what in (
        ("--indentation-increments", INDENTATION_INCREMENTS, "of pre-indentation"),
        ("--stimulus-increments", STIMULUS_INCREMENTS, "of each time of the stimulus"),
        ("--rest-increments", REST_INCREMENTS, "at rest after each of them"),
    ):
        parser.add_argument(
            flag, type=int, default=increments, metavar="N", help=f"increments {what} (default: %(default)d)"
        )


def run(options: argparse.Namespace) -> None:
    """Mesh the scene, find how deep it is indented, and write the deck. Raises UsageError for a deck of another ending
    than DECK.
    """
    output = writable(options.output, [DECK])
    scene, condition, touching = checked_case(options)
    if options.friction_from is not None:
        law = replace(scene.model.contact, friction_from=FrictionFrom(options.friction_from))
        scene = scene.with_model(contact=law)
    law = scene.model.contact
    acting = law.coefficient(touching)
    indenting = acting if law.friction_from is FrictionFrom.TOUCH else 0.0
    settings = DeckSettings(
        height=0.0,  # until it is known how deep
        friction_indenting=indenting,
        friction_acting=acting,
        pressure_slope=options.pressure_slope,
        stick_slope=options.stick_slope,
        indentation_increments=options.indentation_increments,
        stimulus_increments=options.stimulus_increments,
        rest_increments=options.rest_increments,
    )
    # two threads take longer (decision 14), and results depend on their number
    with progress(STEPS, scene.device.name) as bar, threadpool_limits(1):
        section = mesh_device(scene)
        bar.update()
        settings = replace(settings, height=indented_height(scene, section, touching))
        bar.update()
    write_text(output, input_deck(scene, section, condition, settings))
    print(f"written: {output}. {kinematics_told(scene.model.tissue)}")
