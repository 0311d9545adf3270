"""Tissue that softens, snaps or folds: falling forces are followed, what cannot be followed is a named error."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pandas as pd
import pytest
from scipy.sparse import csc_matrix

from fingerpad.arrays import FloatArray
from fingerpad.contact.force_curve import curve_rows, limit_points
from fingerpad.contact.formulation import ContactProblem, Status
from fingerpad.contact.stability import unstable_directions
from fingerpad.errors import CrossingError, InvertedError, SnapError
from fingerpad.figures.kinematics import NO_LIMITS, kinematics_figure
from fingerpad.finite.pressing import Pressed, press_to
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow, Condition, Control, Device
from fingerpad.scene.finger import Finger, Layer, Material
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics, Law
from fingerpad.stress.randomscene import STILL
from fingerpad.tissue.compliance import CondensedBody
from fingerpad.tissue.elasticity import displacement_basis, node_dofs
from fingerpad.tissue.factors import factorise
from fingerpad.tissue.mesh import SectionMesh, nominal_mesh
from fingerpad.tissue.reach import contact_tractions
from fingerpad.tissue.skin import crossing, require_uncrossed, skin_of
from scenes import scene

CONTRAST = 1e4  # of the shell's modulus over that of what it encloses [1]
SHELL = 0.8  # mm thick


def arch(width: float, nail: float) -> Scene:
    """A stiff shell, held by the nail at its ends, over soft tissue on a small bone, and one cylinder beneath.

    A pressed arch carries less and less, while what it encloses resists more and more: with this contrast and this law
    both meet.
    """
    base = scene("device2").with_kinematics(Kinematics.FINITE)
    pad = (Layer("shell", SHELL, Material(10.0, 0.3)), Layer("soft", 8.0 - SHELL, Material(10.0 / CONTRAST, 0.0)))
    dorsal = (Layer("nail", 0.3, Material(100.0, 0.3)), Layer("nail_bed", 0.7, Material(100.0, 0.3)))
    at_edges = {"edge_size": 0.4, "edge_zone": 0.1, "face_size": 0.4}
    sizes = {"receptor_size": 0.8, "nail_size": 2.0, "largest_size": 2.0}
    model = replace(
        base.model,
        finger=Finger(width, 12.0, 3.0, nail, pad, dorsal),
        readout=replace(base.model.readout, layer_above="shell"),
        vibration=STILL,
        tissue=replace(base.model.tissue, law=Law.HENCKY),
        numerics=replace(base.model.numerics, **sizes, **at_edges, indentation_increments=48, max_cuts=2),
    )
    still = Condition("still", "test", 0.0, np.array([1.0]), np.zeros((1, 1)), np.zeros((1, 1)))
    return Scene(model, Device("arch", "arch", Control.DISPLACEMENT, ActuatorRow((0.0,), 1.0, 0.5), (still,)))


def pressed(given: Scene, height: float) -> Pressed:
    section = nominal_mesh(given)
    return press_to(height, given, section, None, Interface.FRICTIONLESS)


@cache
def curve() -> FloatArray:
    """Force against indentation of the arch, to well beyond its limit point."""
    return pressed(arch(12.0, 18.0), 4.6).curve


def test_a_falling_force_is_followed() -> None:
    """The force has one maximum and falls by some percent, evenly: no increment jumps."""
    height, force = curve().T
    (limit,) = np.flatnonzero(limit_points(curve()))
    assert 3.0 < height[limit] < 4.0
    assert force[-1] < 0.98 * force[limit]
    assert np.all(np.diff(force)[: limit - 1] > 0.0)
    assert np.all(np.diff(force)[limit:] < 0.0)
    slope = np.diff(force) / np.diff(height)
    assert np.abs(np.diff(slope)).max() < 0.3 * slope[0]


def test_a_ripple_is_no_limit_point_and_every_crest_is_one() -> None:
    """Increments that were taken back leave ripples in rising forces."""
    rising = np.array([[0.0, 0.0], [1.0, 1.0], [1.5, 0.9995], [2.0, 2.0]])
    assert not limit_points(rising).any()
    small = np.array([[0.0, 0.0], [1.0, 1.0], [1.5, 0.995], [2.0, 2.0]])  # a four-hundredth of the largest force
    assert limit_points(small).tolist() == [False, True, False, False]
    waves = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, 1.0], [3.0, 4.0], [4.0, 3.0]])
    assert limit_points(waves).tolist() == [False, True, False, True, False]


def test_a_vertical_tangent_is_a_named_error() -> None:
    """Beyond it another state is stable, far away: the path ends where it snaps, and says so. Half of the arch, which
    cannot sway, comes farther; there the whole is asked whether it would, if tissue is not turned inside out first.
    """
    given = arch(16.0, 14.0)
    swaying = given.with_model(skips=replace(given.model.skips, mirrored_half=False))
    with pytest.raises(SnapError, match=r"device=arch.*pre-indentation.*% of the way.* would snap"):
        pressed(swaying, 5.2)
    with pytest.raises((SnapError, InvertedError), match=r"device=arch.*pre-indentation.*(branches off|inside out)"):
        pressed(given, 5.2)


def springs(stiffness: FloatArray, status: list[Status], body: CondensedBody | None = None) -> int:
    """Unstable directions of two nodes on springs (4, 4)."""
    problem = ContactProblem(
        position=np.array([[0.0, 0.0], [1.0, 0.0]]),
        compliance=np.linalg.inv(stiffness),
        row=ActuatorRow((0.5,), 3.0, 0.0),
        body=body,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=5,
    )
    return unstable_directions(problem, np.array(status), np.zeros(2), factorise(csc_matrix(stiffness)))


def test_contact_holds_what_is_unstable_without() -> None:
    """A direction of negative stiffness is stable while contact holds it: by pressing if it is normal to the face, by
    sticking if it lies along it."""
    open_, stick, slip = Status.OPEN, Status.STICK, Status.SLIP_FORWARD
    falling, pulled = np.diag([1.0, -1.0, 1.0, 1.0]), np.diag([-1.0, 1.0, 1.0, -1.0])
    assert springs(np.eye(4), [open_, open_]) == 0
    assert springs(falling, [open_, stick]) == 1
    assert springs(falling, [slip, open_]) == 0
    assert springs(pulled, [open_, open_]) == 2
    assert springs(pulled, [slip, slip]) == 1
    assert springs(pulled, [stick, slip]) == 0


@pytest.mark.parametrize(("softer", "unstable"), [(0.5, 0), (2.0, 1)])
def test_a_face_softer_than_what_it_presses_does_not_hold_it(softer: float, unstable: int) -> None:
    """Springs in series, one of stiffness -1: of negative compliance together as long as the face's is below 1."""
    whole = np.kron(np.ones((3, 3)), softer * np.eye(2))  # the face moves as one
    body = CondensedBody(np.array([-1.5, 0.0, 1.5]), whole)
    falling = np.diag([1.0, -1.0, 1.0, 1.0])
    assert springs(falling, [Status.STICK, Status.OPEN], body) == unstable


@cache
def coarse() -> tuple[SectionMesh, np.ndarray]:
    """A coarse section and the unknowns of its nodes."""
    given = scene("device2").coarsened(5.0)
    section = nominal_mesh(given)
    assert contact_tractions(section, given).weight.size > 0
    return section, node_dofs(displacement_basis(section.mesh))


@pytest.mark.parametrize("halved", [False, True])
def test_skin_that_crosses_itself_is_an_error(halved: bool) -> None:
    """It names the place; skin that is squeezed, turned or stretched does not cross."""
    section, dofs = coarse()
    skin = skin_of(section, dofs, halved)
    x, y = section.mesh.doflocs
    field = np.zeros(dofs.size)
    require_uncrossed(skin, field, "at rest")
    field[dofs[0]], field[dofs[1]] = -0.9 * x, 3.0 * y + x
    require_uncrossed(skin, field if not halved else np.zeros_like(field), "squeezed")
    field[:] = 0.0
    field[dofs[0]] = np.where(np.abs(x) < 2.0, -2.0 * x, 0.0)
    with pytest.raises(CrossingError, match=r"the skin crosses itself near x, y = -?\d\.\d+, \d\.\d+ mm when folded"):
        require_uncrossed(skin, field, "when folded")


def test_lines_that_touch_do_not_cross() -> None:
    assert crossing(np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]])) is None
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    assert crossing(np.stack([np.cos(angle), np.sin(angle)], axis=1)) is None
    assert crossing(np.stack([np.cos(angle), np.sin(2.0 * angle)], axis=1)) is not None


def test_limit_points_are_drawn_and_counted() -> None:
    """A figure with one says so; without any its caption does."""
    points = curve_rows("arch", Interface.SHEAR, Kinematics.FINITE, curve())
    scores = [
        {"kinematics": "finite", "device": "arch", "interface": "shear"}
        | {"condition": "a", "dispersion": "low", "phase_deg": 0.0, "readout": readout, "score": 1.0}
        | {"score_error": 0.1, "unit": "strain mm", "note": ""}
        for readout in ("strain", "change_of_strain")
    ]
    for drawn in (points, [point | {"limit_point": False} for point in points]):
        figure = kinematics_figure(pd.DataFrame(scores), pd.DataFrame(drawn), {"arch": "Arch"})
        (legend,) = figure.legends
        marked = "limit point" in [text.get_text() for text in legend.get_texts()]
        said = NO_LIMITS in legend.get_title().get_text().replace("\n", " ")
        assert (marked, said) == ((True, False) if drawn is points else (False, True))
