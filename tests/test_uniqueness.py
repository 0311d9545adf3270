"""Where Coulomb friction has no unique solution (Klarbring 1990): one node, whose answers can be written down."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.contact.formulation import ContactProblem, ContactState, Status, rest
from fingerpad.contact.increment import solve_increment
from fingerpad.contact.not_converged import NotConvergedError
from fingerpad.contact.path import follow
from fingerpad.errors import UniquenessError
from fingerpad.scene.device import ActuatorRow

STIFFNESS = np.array([[1.0, 0.5], [0.5, 1.0]])  # of one node [N/mm per mm]; slip turns where mu k_xy > k_xx, mu = 2
FACE = ActuatorRow((0.0,), 10.0, 0.0)  # flat where the node is


def one_node(friction: float) -> ContactProblem:
    """A node on springs over a flat face that it just touches."""
    return ContactProblem(
        position=np.zeros((1, 2)),
        compliance=np.linalg.inv(STIFFNESS),
        row=FACE,
        body=None,
        friction=friction,
        tolerance=1e-10,
        max_cuts=10,
    )


def sliding(friction: float, sign: float, moved: np.ndarray) -> tuple[float, float]:
    """Pressing force [N/mm] and slip [mm] of a node that slides towards `sign` on a face that has `moved` (2,) [mm].

    f = K u, u_y = moved_y, f_x = -sign mu f_y.
    """
    (k_xx, k_xy), (k_yx, k_yy) = STIFFNESS
    along = -(k_xy + sign * friction * k_yy) * moved[1] / (k_xx + sign * friction * k_yx)
    return float(k_yx * along + k_yy * moved[1]), float(along - moved[0])


@pytest.mark.parametrize("friction", [0.0, 0.3, 1.9])
@pytest.mark.parametrize("move", [(0.0, 0.01), (0.02, 0.01), (-0.02, 0.01)])
def test_below_the_critical_friction_there_is_one_answer(friction: float, move: tuple[float, float]) -> None:
    """The solver finds it, and of stick, slip to either side and separation the others break a law."""
    problem = one_node(friction)
    state = follow(problem, rest(problem, 0.0), np.array([move]), 1)
    admissible = []
    stuck = STIFFNESS @ np.asarray(move)
    if abs(stuck[0]) <= friction * stuck[1]:
        admissible.append(stuck)
    for sign in (1.0, -1.0):
        pressing, slip = sliding(friction, sign, np.asarray(move))
        if friction and pressing > 0.0 and sign * slip > 0.0:
            admissible.append(np.array([-sign * friction * pressing, pressing]))
    if friction == 0.0:
        admissible = [np.array([0.0, sliding(0.0, 1.0, np.asarray(move))[0]])]
    assert len(admissible) == 1
    assert state.force[0] == pytest.approx(admissible[0], rel=1e-9, abs=1e-12)


def wedged() -> tuple[ContactProblem, ContactState, np.ndarray]:
    """Friction 4: the face pressed, went sideways and came down again, and friction alone holds the node on it."""
    problem, moved = one_node(4.0), np.array([0.03, -0.005])
    pressed = follow(problem, rest(problem, 0.0), np.array([[0.0, 0.01]]), 1)
    return problem, follow(problem, pressed, moved[None, :], 4), moved


def test_beyond_it_history_chooses_among_answers() -> None:
    """Stick and separation both obey every law; the path from above ends in one, that from below in the other."""
    problem, from_above, moved = wedged()
    assert from_above.status[0] == Status.STICK
    assert from_above.force[0] == pytest.approx(STIFFNESS @ moved)
    away = follow(problem, rest(problem, 0.0), np.array([[0.0, -0.005]]), 1)
    from_below = follow(problem, away, moved[None, :], 1)
    assert from_below.status[0] == Status.OPEN


def test_a_turned_state_is_refused() -> None:
    """The third answer is not taken for a solution, though it obeys every law and the iteration begins there."""
    problem, state, moved = wedged()
    pressing, slip = sliding(4.0, -1.0, moved)
    turned = replace(
        state,
        status=np.array([int(Status.SLIP_BACKWARD)]),
        force=np.array([[4.0 * pressing, pressing]]),
        place=np.array([slip]),
        drift=np.zeros((1, 2)),
        trend=np.zeros((1, 2)),
        heading=np.array([[1.0, 0.0]]),
    )
    with pytest.raises(NotConvergedError) as failure:
        solve_increment(problem, turned, moved[None, :] + [[1e-4, 0.0]], None)
    assert isinstance(failure.value.reason, UniquenessError)


def test_where_the_branch_ends_the_error_says_why() -> None:
    """Going back, stick reaches the cone and nothing near obeys the laws: the node would jump off."""
    problem, state, _ = wedged()
    with pytest.raises(UniquenessError, match="no unique solution"):
        follow(problem, state, np.array([[0.012, -0.005]]), 3)
