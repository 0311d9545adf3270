"""A device pressed onto tissue that deforms much, and the finger condensed about that state.

Pre-indentation is solved by `deformed`, on the right half of the section where everything mirrors. About the state
(u, f) in which it ends, with tangent K, contact forces f' give
    L^T u' = L^T u + C (f' - f)        displacement of the contact nodes, C = L^T K^-1 L
    H' = G u + G K^-1 L (f' - f)       displacement gradient at the receptors
so that all conditions run on maps that are condensed once, as on linear tissue.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix

from .compliance import GRADIENT, TangentSection
from .condensation import (
    arc_length,
    condense_ordered,
    contact_tractions,
    factorise,
    fill_reducing_order,
    folded_loads,
    receptor_gradient,
    section_stiffness,
    unfold,
    unfolding,
    unit_loads,
)
from .contact import ContactProblem, ContactState, rest, touching_height
from .deformation import elements_of, internal_force_and_tangent
from .deformed import Span, at_rest, solver_on
from .elasticity import displacement_basis
from .hyperelasticity import tissue_of
from .indentation import raise_until
from .mesh import SectionMesh
from .scene import FloatArray, Scene
from .symmetry import MIRROR, fold, mirrors, unfolded
from .traction import Tractions

GRADIENT_MIRROR = np.array([1.0, -1.0, -1.0, 1.0])  # signs of du_x/dx, du_x/dy, du_y/dx, du_y/dy in a mirror


@dataclass(frozen=True)
class Pressed:
    """A device pressed onto the finger.

    section: condensed about that state. state: of all contact nodes. displacement: (2, n_nodes) of the section [mm].
    tangents: condensed on the way.
    """

    section: TangentSection
    state: ContactState
    displacement: FloatArray
    tangents: int


def press(scene: Scene, section: SectionMesh, problem: ContactProblem) -> Pressed:
    """Raise the actuators until the criterion holds, and condense the finger about that state.

    problem: contact of the scene on undeformed tissue. Raises ContactError, CondensationError, InvertedError.
    """
    tractions = contact_tractions(section, scene)
    receptor, gradient = receptor_gradient(section, scene)
    mirrored = scene.model.skips.mirrored_half and mirrors(problem)
    x = section.mesh.doflocs[0]
    chosen = np.flatnonzero(x[section.mesh.t].mean(axis=0) > 0.0) if mirrored else np.arange(section.mesh.t.shape[1])
    matrix, dofs = section_stiffness(section, scene, chosen)
    columns, rows = unfolding(problem.position.shape[0], MIRROR), unfolding(receptor.shape[0], GRADIENT_MIRROR)
    if mirrored:
        left = 2 * np.count_nonzero(columns.side < 0)
        loads: Sequence[csc_matrix] = [
            each[:, left:] for each in folded_loads(section, tractions, dofs, matrix.shape[0])
        ]
        still, axis = np.union1d(dofs[:, section.fixed], dofs[:, x < 0.0]), dofs[:, x == 0.0]
        held = [np.union1d(still, axis[0]), np.union1d(still, axis[1])]
        read = gradient[GRADIENT * np.count_nonzero(rows.side < 0) :]
    else:
        loads = [csc_matrix(unit_loads(dofs, tractions.nodes, matrix.shape[0]) @ tractions.by_component())]
        held, read = [dofs[:, section.fixed].ravel()], gradient
    spans = [_span(scene, section, chosen, matrix, dofs, *each) for each in zip(held, loads, strict=True)]

    pressing = fold(problem) if mirrored else problem
    reached = raise_until(
        pressing,
        scene.model.contact.criterion,
        scene.model.numerics.indentation_increments,
        scene.model.finger.pad_thickness,
        at_rest(spans[0], rest(pressing, touching_height(pressing))),
        solver_on(spans[0]),
    )
    maps = [_condensed(span, reached.displacement, read) for span in spans]
    compliance, of_gradient = (
        (unfold(maps[0][0], maps[1][0], columns, columns), unfold(maps[0][1], maps[1][1], rows, columns))
        if mirrored
        else maps[0][:2]
    )
    displacement = reached.displacement[dofs]
    state: ContactState = reached
    if mirrored:
        displacement, state = _mirrored(section, displacement), unfolded(reached)
    moved = tractions.loads.T @ displacement[:, tractions.nodes].T
    force = state.force.ravel()
    everywhere = np.empty(matrix.shape[0])
    everywhere[dofs] = displacement
    condensed = TangentSection(
        tractions.position,
        tractions.weight,
        compliance,
        receptor,
        arc_length(receptor),
        np.empty((0, force.size)),
        max(each[2] for each in maps),
        moved - (compliance @ force).reshape(-1, 2),
        of_gradient,
        gradient @ everywhere - of_gradient @ force,
    )
    return Pressed(condensed, state, displacement, reached.tangents)


def _span(
    scene: Scene,
    section: SectionMesh,
    chosen: np.ndarray,
    matrix: csc_matrix,
    dofs: np.ndarray,
    held: np.ndarray,
    loads: csc_matrix,
) -> Span:
    """The tissue of chosen elements, some unknowns held, under unit contact forces (n_unknowns, 2m)."""
    free = np.ones(matrix.shape[0], dtype=bool)
    free[held] = False
    order = fill_reducing_order(matrix, dofs, free)
    finger, law = scene.model.finger, scene.model.tissue
    materials = [layer.material for layer in (*finger.pad, *finger.dorsal)]
    tissue = tissue_of(law.law, law.ogden_exponent, materials, section.layer[chosen][:, None])
    basis = displacement_basis(section.mesh, chosen)
    return Span(elements_of(basis, tissue, order), csc_matrix(loads[order]))


def _condensed(span: Span, displacement: FloatArray, read: csr_matrix) -> tuple[FloatArray, FloatArray, float]:
    """Compliance, map to what is read (rows of all unknowns), and residual, about a displacement (size,)."""
    _, matrix = internal_force_and_tangent(span.elements, displacement)
    return condense_ordered(matrix, factorise(matrix), span.loads, csr_matrix(read[:, span.elements.free]))


def _mirrored(section: SectionMesh, right: FloatArray) -> FloatArray:
    """Displacement (2, n_nodes) of the whole section from that of its right half."""
    x, y = section.mesh.doflocs
    twin = np.empty(x.size, dtype=np.int64)
    twin[np.lexsort((y, x))] = np.lexsort((y, -x))
    return np.where(x < 0.0, right[:, twin] * MIRROR[:, None], right)
