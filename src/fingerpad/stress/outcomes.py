"""What becomes of random scenes: each ends in a certified solution or in a named error, and in nothing else."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from itertools import groupby

import numpy as np

from ..contact.linear_solution import solve_condition
from ..contact.solution import Solution
from ..errors import CertificateError, FingerpadError, MeshError
from ..finite.deformed_solution import press_finger, stimulate_deformed
from ..scene.contact_law import Interface
from ..scene.device import ActuatorRow, Condition
from ..scene.scene import Scene
from ..tissue.actuator_body import body_of
from ..tissue.compliance import CondensedSection
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh, mesh_section, nominal_edges
from ..tissue.reach import contact_tractions
from .randomscene import GROUP, random_deformed_scene, random_group, random_scene

SOLVED = "solved"
MOST_CONTACT = 400  # skin nodes that may come into contact [1]; source: a scene then takes about a second
# with finite kinematics; source: a scene then takes some seconds
MOST_DEFORMED_CONTACT = 100  # skin nodes that may come into contact [1]
MOST_DEFORMED_UNKNOWNS = 4000  # [1]
COARSENINGS = (1.0, 2.0, 4.0, 8.0, 16.0)  # times the sizes that a random finger asks for [1]


@dataclass(frozen=True)
class Outcome:
    """What became of a scene.

    kinematics, number: of the scene. friction [1], actuators, deformable, criterion, stimulus: what it is.
    contact_nodes: on the skin. outcome: SOLVED, or the class of the error; message: its text. iterations, cuts,
    searches: of the solution (see ContactState), zero without one. largest_strain: at the receptors [1].
    """

    kinematics: str
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


@dataclass(frozen=True)
class DeformedOutcome(Outcome):
    """What became of a scene with finite kinematics.

    law: of its tissue. poisson: largest [1]. unknowns: of its mesh.
    """

    law: str
    poisson: float
    unknowns: int


def outcomes(numbers: Sequence[int]) -> Iterator[Outcome]:
    """Outcomes of the scenes of these numbers; neighbours share what is condensed.

    Anything but a solution or a FingerpadError goes up to the caller, warnings and invalid numbers included.
    """
    for group, members in groupby(numbers, lambda number: number // GROUP):
        with strict():
            try:
                section: CondensedSection | FingerpadError = condensed_group(group)
            except FingerpadError as error:
                section = error
        for number in members:
            with strict():
                found = outcome(number, section)
            yield found


@contextmanager
def strict() -> Iterator[None]:
    """Make errors of warnings and invalid numbers."""
    with warnings.catch_warnings(), np.errstate(divide="raise", over="raise", invalid="raise"):
        warnings.simplefilter("error")
        yield


def deformed_outcomes(numbers: Sequence[int]) -> Iterator[DeformedOutcome]:
    """`outcomes` of the scenes with finite kinematics of these numbers, each meshed, pressed and stimulated."""
    for number in numbers:
        with strict():
            found = _deformed_outcome(random_deformed_scene(number), number)
        yield found


def _deformed_outcome(scene: Scene, number: int) -> DeformedOutcome:
    """The outcome of a scene with finite kinematics."""
    section: SectionMesh | None = None
    result: Solution | FingerpadError
    try:
        section = coarse_section(scene)
        result = deformed_solution(scene, section)
    except FingerpadError as error:
        result = error
    nodes = contact_tractions(section, scene).weight.size if section else 0
    layers = scene.model.finger.layers
    return DeformedOutcome(
        **asdict(_outcome(number, scene, nodes, result)),
        law=str(scene.model.tissue.law),
        poisson=max(layer.material.poisson for layer in layers),
        unknowns=section.unknowns if section else 0,
    )


def coarse_section(scene: Scene) -> SectionMesh:
    """The section of a scene with finite kinematics. Raises MeshError if no mesh can be had."""
    return _coarsened(scene, scene, MOST_DEFORMED_CONTACT, MOST_DEFORMED_UNKNOWNS)


def _coarsened(scene: Scene, covering: Scene, most_contact: int, most_unknowns: float) -> SectionMesh:
    """The section of a scene on the first of ever coarser meshes with no more than so many unknowns, and so many nodes
    that may come into contact with the covering scene's row; if there is none, on the coarsest one that can be had on
    which each actuator of that row has a node.

    Raises MeshError if no mesh can be had.
    """
    edges, row, section, failure = nominal_edges(scene.device.actuators), covering.device.actuators, None, MeshError()
    for coarsening in COARSENINGS:
        try:
            coarser = mesh_section(scene.coarsened(coarsening), edges)
            nodes = contact_tractions(coarser, covering).position
        except MeshError as error:
            failure = error
            continue
        if section and np.unique(row.nearest(nodes[:, 0])).size < len(row.positions):
            break
        section = coarser
        if nodes.shape[0] <= most_contact and section.unknowns <= most_unknowns:
            break
    if section is None:
        raise failure
    return section


def deformed_solution(scene: Scene, section: SectionMesh) -> Solution:
    """The solution with friction of a scene with finite kinematics. Raises FingerpadError."""
    body, (condition,) = body_of(scene), scene.device.conditions
    finger = press_finger(scene, section, body, Interface.SHEAR)
    return _with_numbers(stimulate_deformed(scene, finger, condition))


def condensed_group(number: int) -> CondensedSection:
    """The finger of a group, condensed to all skin that its scenes may touch. Raises MeshError, CondensationError."""
    scene = random_group(number)
    row, (farthest,) = scene.device.actuators, scene.device.conditions
    whole = ActuatorRow((0.0,), row.positions[-1] - row.positions[0] + row.width, 0.0)
    stroke = replace(farthest, normal=farthest.normal[:, :1], tangential=farthest.tangential[:, :1])
    covering = Scene(scene.model, replace(scene.device, actuators=whole, conditions=(stroke,)))
    return condense_section(_coarsened(scene, covering, MOST_CONTACT, np.inf), covering)


def outcome(number: int, section: CondensedSection | FingerpadError) -> Outcome:
    """The outcome of one scene. section: its group's condensed finger, or the error for which there is none."""
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
    nodes = section.position.shape[0] if isinstance(section, CondensedSection) else 0
    return _outcome(number, scene, nodes, result)


def _outcome(number: int, scene: Scene, contact_nodes: int, result: Solution | FingerpadError) -> Outcome:
    found = result if isinstance(result, Solution) else None
    return Outcome(
        kinematics=str(scene.kinematics),
        number=number,
        friction=scene.model.contact.friction,
        actuators=len(scene.device.actuators.positions),
        deformable=scene.device.actuators.body is not None,
        criterion=str(scene.model.contact.criterion),
        stimulus=scene.device.conditions[0].name,
        contact_nodes=contact_nodes,
        outcome=SOLVED if found else type(result).__name__,
        message="" if found else str(result),
        iterations=found.iterations if found else 0,
        cuts=found.cuts if found else 0,
        searches=found.searches if found else 0,
        largest_strain=float(found.reading.strain.max()) if found else 0.0,
    )


def solved(scene: Scene, section: CondensedSection, condition: Condition) -> Solution:
    """The scene's solution with friction. Raises FingerpadError, also if a number in it is not finite."""
    body = body_of(scene)
    return _with_numbers(solve_condition(scene, section, body, condition, Interface.SHEAR))


def _with_numbers(solution: Solution) -> Solution:
    """The solution. Raises CertificateError if a number in it is not finite."""
    numbers = {"force": solution.force, "pressure": solution.pressure, "shear": solution.shear, "place": solution.place}
    for name, values in (numbers | solution.reading.readouts).items():
        if not np.all(np.isfinite(values)):
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
