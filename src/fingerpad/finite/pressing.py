"""A device pressed onto tissue that deforms much, and its contact nodes condensed about that state.

Pre-indentation is solved by `deformed`, on the right half of the section where everything mirrors. About the state
(u, f) in which it ends, with tangent K, contact forces f' move the contact nodes by
    W^T u' = W^T u + C (f' - f),        C = W^T K^-1 W,
so that all conditions run on a compliance that is condensed once, as on linear tissue (`deformed_path`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_matrix

from ..arrays import FloatArray
from ..contact.advice import named_pressing
from ..contact.certificate import require_within_reach
from ..contact.force_curve import curve_of
from ..contact.formulation import ContactProblem, ContactState, rest, touching_height
from ..contact.indentation import raise_until
from ..contact.path import SolveIncrement, advance, recording
from ..contact.problem import contact_problem, indentation_increments, once_pressed, pressing_problem
from ..contact.symmetry import half_of, mirrors, unfolded
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from ..tissue.compliance import MIRROR, CondensedBody, CondensedSection, displaced
from ..tissue.elasticity import displacement_basis
from ..tissue.factors import fill_reducing_order
from ..tissue.halves import Parts, right_half, unfold, unfolding, whole
from ..tissue.mesh import SectionMesh
from ..tissue.reach import contact_tractions
from ..tissue.receptors import arc_length, receptor_strain
from ..tissue.skin import require_uncrossed, skin_of
from ..tissue.traction import Tractions
from .deformation import elements_of
from .deformed import (
    DeformedState,
    Tangent,
    TissuePart,
    contact_state,
    deformed_state,
    increments_of,
    require_stable,
    solver_on,
    tangent_at,
)
from .ellipticity import require_elliptic
from .hyperelasticity import scene_tissue

NONE = np.empty((0, 0))  # a map that nobody asks for


@dataclass(frozen=True)
class Pressed:
    """A device pressed onto the finger.

    section: condensed about that state; without a strain map, as strain follows from displacements; its residual is the
    factorisation's, or what the tissue had left to move, over the load, whichever is larger. free: (n, 2)
    displacement that contact nodes would have without contact forces, had the tangent held all the way [mm]. state: of
    all contact nodes. displacement: (2, n_nodes) of the section [mm]. curve: (k, 2) heights above first touch [mm] and
    pressing forces [N/mm] on the way.
    """

    section: CondensedSection
    free: FloatArray
    state: ContactState
    displacement: FloatArray
    curve: FloatArray


@dataclass(frozen=True)
class _Start:
    """Where pre-indentation begins: on the right half of the section where everything mirrors, on the whole otherwise.

    tractions, undeformed: of all contact nodes; the section has no maps, as nobody asks for them. parts: of the section
    that are solved. tissues: of each kind of loads. problem: of the parts' contact nodes, whatever its compliance;
    whole: of all; acting: of all, from the stimulus on. state: at first touch. increments: of the tissue, and of
    contact in each.
    """

    tractions: Tractions
    undeformed: CondensedSection
    parts: Parts
    tissues: tuple[TissuePart, ...]
    problem: ContactProblem
    whole: ContactProblem
    acting: ContactProblem
    state: DeformedState
    increments: tuple[int, int]


def press(scene: Scene, section: SectionMesh, body: CondensedBody | None, interface: Interface) -> Pressed:
    """Raise the actuators until the criterion holds, and condense the contact nodes about that state.

    Raises MeshError, CondensationError, and ContactError, naming device and interface, if the path cannot be followed.
    """
    start = _start(scene, section, body, interface)
    solve, states = _recorded(section, start)
    law, limit = scene.model.contact, scene.model.finger.pad_thickness
    with named_pressing(scene, interface):
        reached = raise_until(start.problem, law, start.increments[0], limit, start.state, solve)
        require_elliptic(start.tissues[0].elements, reached.displacement)
        return _pressed(section, start, states, reached)


def press_to(
    height: float, scene: Scene, section: SectionMesh, body: CondensedBody | None, interface: Interface
) -> Pressed:
    """`press`, to a height of the faces above the undeformed pad's lowest point [mm]. Nobody asks whether tissue is
    still elliptic there: programs are compared, on one mesh. Raises as `press`.
    """
    start = _start(scene, section, body, interface)
    solve, states = _recorded(section, start)
    target = np.full_like(start.state.actuator, height) * [0.0, 1.0]
    with named_pressing(scene, interface):
        reached, _ = advance(start.problem, start.state, target, start.increments[0], None, solve)
        return _pressed(section, start, states, reached)


def _start(scene: Scene, section: SectionMesh, body: CondensedBody | None, interface: Interface) -> _Start:
    """Where a scene's pre-indentation begins. Raises MeshError."""
    tractions = contact_tractions(section, scene)
    receptor, _ = receptor_strain(section, scene)
    undeformed = CondensedSection(
        position=tractions.position,
        weight=tractions.weight,
        compliance=NONE,
        receptor=receptor,
        arc=arc_length(receptor),
        strain=NONE,
        residual=0.0,
    )
    acting = contact_problem(scene, undeformed, body, interface)
    problem = pressing_problem(scene, acting)
    mirrored = scene.model.skips.mirrored_half and mirrors(problem)
    parts = right_half(section, tractions) if mirrored else whole(section, tractions)
    solved = half_of(problem) if mirrored else problem
    return _Start(
        tractions=tractions,
        undeformed=undeformed,
        parts=parts,
        tissues=tuple(_part(scene, section, parts, which) for which in range(len(parts.held))),
        problem=solved,
        whole=problem,
        acting=acting,
        state=deformed_state(rest(solved, touching_height(solved)), np.zeros(parts.dofs.size)),
        increments=increments_of(indentation_increments(scene, problem)),
    )


def _recorded(
    section: SectionMesh, start: _Start
) -> tuple[SolveIncrement[DeformedState, Tangent | None], list[ContactState]]:
    """What solves an increment, of skin that may not cross itself, and the states that it will have found."""
    states: list[ContactState] = []
    skin = skin_of(section, start.parts.dofs, start.problem.halved)

    def note(state: DeformedState) -> None:
        states.append(state)
        when = f"in increment {len(states)} of the tissue, with the faces at {state.actuator[0, 1]:.4g} mm"
        require_uncrossed(skin, state.displacement, when)

    return recording(_within_reach(start, solver_on(start.tissues[0], start.increments[1])), note), states


def _within_reach(
    start: _Start, solve: SolveIncrement[DeformedState, Tangent | None]
) -> SolveIncrement[DeformedState, Tangent | None]:
    """An increment's solver that raises ReachError where contact has left the skin that was considered: what follows
    is no solution, and may take minutes. An increment too far, which is taken back, may leave it.
    """

    def solve_from(
        problem: ContactProblem, state: DeformedState, actuator: FloatArray, tangent: Tangent | None
    ) -> tuple[DeformedState, Tangent | None]:
        contact = contact_state(state)
        everywhere = unfolded(contact, start.problem) if start.problem.halved else contact
        require_within_reach(start.whole, start.undeformed, everywhere)
        return solve(problem, state, actuator, tangent)

    return solve_from


def _pressed(section: SectionMesh, start: _Start, states: Sequence[ContactState], reached: DeformedState) -> Pressed:
    """What is pressed to a state, by way of others. Raises SnapError, InvertedError, CondensationError."""
    tangents = [tangent_at(tissue, reached.displacement) for tissue in start.tissues]
    for tangent in tangents:
        require_stable(start.problem, reached, tangent)
    displacement, state = reached.displacement[start.parts.dofs], contact_state(reached)
    curve, compliance = curve_of(states, float(start.state.actuator[0, 1]), reached), tangents[0].compliance
    if start.problem.halved:
        displacement, state = _mirrored(section, displacement), unfolded(state, start.problem)
        curve = curve * [1.0, start.problem.images]
        columns = unfolding(start.tractions.position.shape[0], MIRROR)
        compliance = unfold(compliance, tangents[1].compliance, columns, columns)
    state = once_pressed(state, start.whole, start.acting)
    moved = start.tractions.loads.T @ displacement[:, start.tractions.nodes].T
    free = moved - displaced(compliance, state.force)
    residual = max(reached.change, *(tangent.residual for tangent in tangents))
    condensed = replace(start.undeformed, compliance=compliance, residual=residual)
    return Pressed(section=condensed, free=free, state=state, displacement=displacement, curve=curve)


def whole_part(scene: Scene, section: SectionMesh) -> TissuePart:
    """The tissue of the whole section. Raises MeshError as `contact_tractions`."""
    return _part(scene, section, whole(section, contact_tractions(section, scene)), 0)


def _part(scene: Scene, section: SectionMesh, parts: Parts, which: int) -> TissuePart:
    """The tissue with one choice of what is held."""
    loads = parts.loads[which]
    basis = displacement_basis(section.mesh, parts.elements)
    joined = _coupling(basis.element_dofs, parts.dofs.size)
    order = fill_reducing_order(joined, parts.dofs, parts.held[which])
    tissue = scene_tissue(scene, section.layer[parts.elements][:, None])
    return TissuePart(elements_of(basis, tissue, order), csc_matrix(loads[order]))


def _coupling(element_dofs: np.ndarray, size: int) -> csc_matrix:
    """Matrix (size, size) with entries where elements join unknowns (12, n_elements): the tangent's, in no time."""
    count, elements = element_dofs.shape
    within = csc_matrix((np.ones(element_dofs.size), element_dofs.T.ravel(), np.arange(elements + 1) * count))
    within.resize(size, elements)
    return csc_matrix(within @ within.T)


def _mirrored(section: SectionMesh, right: FloatArray) -> FloatArray:
    """Displacement (2, n_nodes) of the whole section from that of its right half."""
    x, y = section.mesh.doflocs
    twin = np.empty(x.size, dtype=np.int64)
    twin[np.lexsort((y, x))] = np.lexsort((y, -x))
    return np.where(x < 0.0, right[:, twin] * MIRROR[:, None], right)
