"""Energy of shipped devices: what actuators put into the finger, it stores or friction dissipates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.energy import stored_energy
from fingerpad.contact.force_curve import small_strain_curve
from fingerpad.contact.linear_solution import indent_device
from fingerpad.contact.problem import contact_problem
from fingerpad.finite.deformation import displacement_gradient
from fingerpad.finite.pressing import press, whole_part
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.elasticity import displacement_basis, node_dofs
from fingerpad.tissue.mesh import nominal_mesh
from scenes import scene

COARSER = 2.0  # times the shipped sizes
FINER = 4  # times the shipped increments
# What may be left over the work [1]. Measured: 2e-5; with finite strain, in fewer increments, 8e-4. Without friction
# skin that slides on an edge's slope does work that is not counted (docs/decisions/0002): 9e-4 and 1.8e-3.
LEFT = {
    Interface.SHEAR: {Kinematics.SMALL: 1e-4, Kinematics.FINITE: 2e-3},
    Interface.FRICTIONLESS: {Kinematics.SMALL: 2e-3, Kinematics.FINITE: 4e-3},
}


def small(pressed: Scene, interface: Interface) -> tuple[FloatArray, float, float]:
    """Force against height, stored and dissipated energy [N] of pre-indentation."""
    section = condense_section(nominal_mesh(pressed), pressed)
    state = indent_device(pressed, section, None, interface).state
    force = state.force.ravel()
    curve = small_strain_curve(pressed, contact_problem(pressed, section, None, interface))
    return curve, float(force @ section.compliance @ force) / 2.0, state.dissipation


def finite(pressed: Scene, interface: Interface) -> tuple[FloatArray, float, float]:
    """The same of tissue that deforms much."""
    section = nominal_mesh(pressed)
    found = press(pressed, section, None, interface)
    elements = whole_part(pressed, section).elements
    dofs = node_dofs(displacement_basis(section.mesh))
    displacement = np.empty(dofs.size)
    displacement[dofs] = found.displacement
    stored = stored_energy(elements.tissue, displacement_gradient(elements, displacement)).real
    return found.curve, float((stored * elements.weight).sum()), found.state.dissipation


@pytest.mark.parametrize("interface", list(Interface))
@pytest.mark.parametrize(("kinematics", "solve"), [(Kinematics.SMALL, small), (Kinematics.FINITE, finite)])
def test_work_of_pressing_is_stored_or_dissipated(
    kinematics: Kinematics, solve: Callable[[Scene, Interface], tuple[FloatArray, float, float]], interface: Interface
) -> None:
    base = scene("device2").coarsened(COARSER).with_kinematics(kinematics)
    numerics = base.model.numerics
    finer = replace(numerics, indentation_increments=FINER * numerics.indentation_increments)
    curve, stored, dissipated = solve(base.with_model(numerics=finer), interface)
    work = float(np.trapezoid(curve[:, 1], curve[:, 0]))
    assert abs(work - stored - dissipated) < LEFT[interface][kinematics] * work
