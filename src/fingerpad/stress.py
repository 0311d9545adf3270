"""What becomes of random scenes: each ends in a certified solution or in a named error, and in nothing else."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from .compliance import CondensedSection
from .condensation import body_of, condense_section, contact_tractions
from .errors import CertificateError, FingerpadError, MeshError
from .mesh import mesh_section, nominal_edges
from .randomscene import GROUP, random_group, random_scene
from .scene import ActuatorRow, Condition, Interface, Scene
from .solution import Solution, solve_condition

SOLVED = "solved"
MOST_CONTACT = 400  # skin nodes that may come into contact [1]; source: a scene then takes about a second
COARSENINGS = (1.0, 2.0, 4.0, 8.0, 16.0)  # times the sizes that a random finger asks for [1]


@dataclass(frozen=True)
class Outcome:
    """What became of a scene.

    number: of the scene. friction [1], actuators, deformable, criterion, stimulus: what it is. contact_nodes: on the
    skin. outcome: SOLVED, or the class of the error; message: its text. iterations, cuts, searches: of the solution
    (see ContactState), zero without one. largest_strain: at the receptors [1].
    """

    number: int
    friction: float
    actuators: int
    deformable: bool
    criterion: str
    stimulus: str
    contact_nodes: int
    outcome: str
    message: str
    iterations: int
    cuts: int
    searches: int
    largest_strain: float


def outcomes(numbers: Sequence[int]) -> Iterator[Outcome]:
    """Outcomes of the scenes of these numbers; neighbours share what is condensed.

    Anything but a solution or a FingerpadError goes up to the caller, warnings and invalid numbers included.
    """
    with warnings.catch_warnings(), np.errstate(divide="raise", over="raise", invalid="raise"):
        warnings.simplefilter("error")
        for group, members in groupby(numbers, lambda number: number // GROUP):
            try:
                section: CondensedSection | FingerpadError = condensed_group(group)
            except FingerpadError as error:
                section = error
            for number in members:
                yield outcome(number, section)


def condensed_group(number: int) -> CondensedSection:
    """The finger of a group, condensed to all skin that its scenes may touch, on a mesh that is coarsened until no more
    than MOST_CONTACT nodes may come into contact. Raises MeshError, CondensationError.
    """
    scene = random_group(number)
    row, (farthest,) = scene.device.actuators, scene.device.conditions
    whole = ActuatorRow((0.0,), row.positions[-1] - row.positions[0] + row.width, 0.0)
    stroke = replace(farthest, normal=farthest.normal[:, :1], tangential=farthest.tangential[:, :1])
    covering = Scene(scene.model, replace(scene.device, actuators=whole, conditions=(stroke,)))
    for coarsening in COARSENINGS:
        coarser = scene.coarsened(coarsening)
        with suppress(MeshError):
            section = mesh_section(coarser, nominal_edges(row))
            if contact_tractions(section, covering).weight.size <= MOST_CONTACT:
                return condense_section(section, covering)
    return condense_section(mesh_section(coarser, nominal_edges(row)), covering)


def outcome(number: int, section: CondensedSection | FingerpadError) -> Outcome:
    """The outcome of one scene on its group's condensed finger, or on why there is none."""
    scene = random_scene(number)
    (condition,) = scene.device.conditions
    result: Solution | FingerpadError
    if isinstance(section, FingerpadError):
        result = section
    else:
        try:
            result = solved(scene, section, condition)
        except FingerpadError as error:
            result = error
    found = isinstance(result, Solution)
    return Outcome(
        number,
        scene.model.contact.friction,
        len(scene.device.actuators.positions),
        scene.device.actuators.body is not None,
        str(scene.model.contact.criterion),
        condition.name,
        section.position.shape[0] if isinstance(section, CondensedSection) else 0,
        SOLVED if found else type(result).__name__,
        "" if found else str(result),
        result.iterations if isinstance(result, Solution) else 0,
        result.cuts if isinstance(result, Solution) else 0,
        result.searches if isinstance(result, Solution) else 0,
        float(result.strain.max()) if isinstance(result, Solution) else 0.0,
    )


def solved(scene: Scene, section: CondensedSection, condition: Condition) -> Solution:
    """The scene's solution with friction. Raises FingerpadError, also if a number in it is not finite."""
    body = body_of(scene)
    solution = solve_condition(scene, section, body, condition, Interface.SHEAR)
    for name in ("force", "pressure", "shear", "place", "strain", "change_of_strain"):
        if not np.all(np.isfinite(getattr(solution, name))):
            raise CertificateError(f"{name} is not finite")
    return solution


def summary(rows: Sequence[Mapping[str, str]]) -> list[dict[str, str]]:
    """Shares of outcomes and the costliest scene, from rows of outcomes as text (a table that was read)."""
    total = len(rows)
    done = [row for row in rows if row["outcome"] == SOLVED]
    cut = [row for row in done if int(row["cuts"])]
    searched = [row for row in done if int(row["searches"])]
    at_once = [row for row in done if not int(row["cuts"]) and not int(row["searches"])]
    costliest = max(done, key=lambda row: int(row["iterations"]), default=None)
    shares = {
        SOLVED: len(done),
        "solved at once": len(at_once),
        "solved with increments cut": len(cut),
        "solved with a line search, one node at a time": len(searched),
    }
    for name in sorted({row["outcome"] for row in rows} - {SOLVED}):
        shares[name] = sum(row["outcome"] == name for row in rows)
    table = [
        {"what": what, "scenes": str(count), "share": f"{count / total:.4f}", "number": "", "iterations": ""}
        for what, count in {"all": total, **shares}.items()
    ]
    if costliest:
        table.append(
            {
                "what": "solved with the most iterations",
                "scenes": "1",
                "share": f"{1 / total:.4f}",
                "number": costliest["number"],
                "iterations": costliest["iterations"],
            }
        )
    return table
