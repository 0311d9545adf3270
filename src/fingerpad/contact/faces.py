"""Deformable faces: where the skin touches them, and how they give way."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..tissue.compliance import CondensedBody, displaced
from .formulation import ContactProblem

# Gauss-Jacobi on half a hat, exact for cubics: distances from its top over its width [1], weights [1] with a sum of one
HAT_POINTS = np.array([0.4 - np.sqrt(0.06), 0.4 + np.sqrt(0.06)])
HAT_WEIGHTS = np.array([0.5 + 1.0 / np.sqrt(54.0), 0.5 - 1.0 / np.sqrt(54.0)])


def touch(problem: ContactProblem, place: FloatArray) -> FloatArray | None:
    """Where skin nodes at their places (n,) [mm] touch the deformable faces: shape functions (n, k) of the k nodes of
    their actuator's face there; None if the actuators are rigid.

    A node's force is spread over the skin under its hat, and its place is the mean there: so it feels the face's mean
    there too (docs/decisions/0024).
    """
    if problem.body is None:
        return None
    sides, shares = problem.hats
    at = place - sides.sum(axis=0) / 3.0 + HAT_POINTS[:, None, None] * sides
    weight = HAT_WEIGHTS[:, None, None] * shares
    return face_shape(problem.body, at.reshape(-1, place.size), weight.reshape(-1, place.size))


def displacement(problem: ContactProblem, force: FloatArray, there: FloatArray | None) -> FloatArray:
    """Displacement (n, 2) [mm] of the skin relative to the actuators' faces: C f and what these give way."""
    moved = displaced(problem.compliance, force)
    return moved if there is None else moved + face_displacement(problem, force, there)


def nodal_compliance(problem: ContactProblem, nodes: np.ndarray, there: FloatArray | None) -> FloatArray:
    """Compliance (2b, 2b) [mm per N/mm] of some nodes (b,), ascending, ordered x0, x1, ..., y0, y1, ..., all others
    unloaded: of the skin, and of deformable faces where it touches them.
    """
    unknowns = np.concatenate([2 * nodes, 2 * nodes + 1])
    compliance: FloatArray = problem.compliance.take(unknowns, 0).take(unknowns, 1)
    return compliance if there is None else compliance + face_compliance(problem, there, nodes)


def face_displacement(problem: ContactProblem, force: FloatArray, there: FloatArray) -> FloatArray:
    """By how much (n, 2) [mm] deformable faces give way under forces (n, 2) [N/mm] on skin that touches `there`."""
    given = np.zeros_like(force)
    if problem.body is not None:
        for own in problem.spans:
            shape = there[own]
            given[own] = shape @ displaced(problem.body.compliance, shape.T @ force[own])
    return given


def face_compliance(problem: ContactProblem, there: FloatArray, nodes: np.ndarray) -> FloatArray:
    """Compliance (2b, 2b) [mm per N/mm] of deformable faces under some nodes (b,), ascending, ordered x0, x1, ..., y0,
    y1, ...
    """
    found = np.zeros((2, nodes.size, 2, nodes.size))
    if problem.body is not None:
        size = problem.body.coordinate.size
        for span in problem.spans:
            own = slice(*np.searchsorted(nodes, [span.start, span.stop]))
            shape = there[nodes[own]]
            count = shape.shape[0]
            by_face = (shape @ problem.body.compliance.reshape(size, -1)).reshape(count, 2, size, 2)
            by_skin = by_face.transpose(1, 0, 3, 2).reshape(-1, size) @ shape.T
            found[:, own, :, own] = by_skin.reshape(2, count, 2, count)
    return found.reshape(2 * nodes.size, 2 * nodes.size)


def face_shape(body: CondensedBody, at: FloatArray, weight: FloatArray) -> FloatArray:
    """Second-order shape functions (n, k) of the face's k nodes: means of those at coordinates (p, n) [mm], held at the
    face's ends beyond, with weights (p, n) [1].
    """
    nodes, count = body.coordinate, at.shape[1]
    at = np.minimum(np.maximum(at, nodes[0]), nodes[-1])
    left = 2 * np.minimum(np.searchsorted(nodes[2::2], at, side="right"), nodes.size // 2 - 1)
    local = (at - nodes[left]) / (nodes[left + 2] - nodes[left])
    values = weight * np.array(
        [(1.0 - local) * (1.0 - 2.0 * local), 4.0 * local * (1.0 - local), local * (2.0 * local - 1.0)]
    )
    place = left + nodes.size * np.arange(count) + np.arange(3)[:, None, None]
    shape = np.bincount(place.ravel(), values.ravel(), minlength=count * nodes.size)
    return np.asarray(shape, dtype=float).reshape(count, nodes.size)
