"""States of the whole section on the way of a stimulus: displacement, strain and stress of small and finite kinematics.

Strain is the linear one, or Hencky's, ln U; stress is Hooke's, or Cauchy's. Both are read at points of every element,
as they jump between elements: the stress's deviator where it is, its mean as `mean_stress` recovers it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from skfem import MeshTri2

from ..arrays import FloatArray
from ..contact.formulation import shearing_and_pressing
from ..contact.linear_solution import solve_condition
from ..contact.solution import Solution
from ..finite.deformed_solution import PressedFinger, certified_equilibria, press_finger
from ..finite.finite_strain import logarithmic_strain
from ..finite.hyperelasticity import cauchy_stress, scene_tissue
from ..readouts.measures import stress
from ..readouts.strain import maximum_principal
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.actuator_body import body_of
from ..tissue.condensation import condense_section
from ..tissue.elasticity import displacement_basis
from ..tissue.mesh import NODES, SectionMesh
from .mean_stress import element_means, recover_linear
from .recovery import gradient_at, recover_displacement, strain_of
from .section_fields import Fields

CORNERS = NODES[:, :3]  # of the reference triangle


@dataclass(frozen=True)
class States:
    """The pre-indented state, and those at a stimulus's times.

    displacement: (n_states, 2, n_nodes) [mm]. contact: (n_states, n_contact, 2) shearing and pressing forces on the
    skin [N/mm].
    """

    displacement: FloatArray
    contact: FloatArray

    @property
    def last(self) -> States:
        """The last state alone."""
        return States(self.displacement[-1:], self.contact[-1:])


def solved_states(scene: Scene, section: SectionMesh, condition: Condition, interface: Interface) -> States:
    """Solve a condition, and what it does to the whole section. Raises MeshError, CondensationError, ContactError."""
    body = body_of(scene)
    if scene.kinematics is Kinematics.FINITE:
        return deformed_states(scene, press_finger(scene, section, body, interface), condition)
    condensed = condense_section(section, scene)
    return linear_states(scene, section, solve_condition(scene, condensed, body, condition, interface))


def linear_states(scene: Scene, section: SectionMesh, solution: Solution) -> States:
    """States of linear tissue, from the contact forces of a solution. Raises what `recover_displacement` raises."""
    return States(recover_displacement(section, scene, solution.force), solution.contact)


def deformed_states(scene: Scene, finger: PressedFinger, condition: Condition) -> States:
    """States of tissue that deforms much, which follow from no forces alone: the stimulus is solved. Raises
    ContactError.
    """
    found, _ = certified_equilibria(scene, finger, condition)
    return States(
        np.array([each.displacement[finger.dofs] for each in found]),
        shearing_and_pressing(finger.problem, [each.state for each in found]),
    )


def strain_at(scene: Scene, mesh: MeshTri2, displacement: FloatArray, points: FloatArray) -> FloatArray:
    """Strain (n_elements k, 3) [1], e_11, e_22, 2 e_12, at reference points (2, k) of every element, one element after
    the other. displacement: (2, n_nodes) [mm].
    """
    gradient = gradient_at(mesh, displacement, points)
    return logarithmic_strain(gradient).T if scene.kinematics is Kinematics.FINITE else strain_of(gradient)


def stress_at(scene: Scene, section: SectionMesh, displacement: FloatArray, points: FloatArray) -> FloatArray:
    """Stress (n_elements k, 4) [MPa], xx, yy, zz, xy, of each element's own layer, where `strain_at` has strain.

    sigma + (m - tr sigma / 3) I with sigma that of the strain there, and m from means of tr sigma / 3 over elements.
    """
    basis = displacement_basis(section.mesh)
    means = element_means(basis, _mean(_stress(scene, section, displacement, basis.X)).reshape(section.layer.size, -1))
    found = _stress(scene, section, displacement, points)
    recovered = recover_linear(basis, section.layer, means, section.mesh.mapping().F(points))
    found[:, :3] += (recovered.ravel() - _mean(found))[:, None]
    return found


def _mean(stresses: FloatArray) -> FloatArray:
    """Mean stress (n,) [MPa] of stresses (n, 4)."""
    return stresses[:, :3].mean(axis=1)


def _stress(scene: Scene, section: SectionMesh, displacement: FloatArray, points: FloatArray) -> FloatArray:
    """Stress (n_elements k, 4) [MPa] that belongs to the strain of each point."""
    gradient = gradient_at(section.mesh, displacement, points)
    layer = np.repeat(section.layer, points.shape[1])
    if scene.kinematics is Kinematics.FINITE:
        return cauchy_stress(scene_tissue(scene, layer), gradient).T
    found = np.empty((layer.size, 4))
    for number, material in enumerate(scene.model.finger.materials):
        inside = layer == number
        found[inside] = stress(strain_of(gradient[..., inside]).ravel(), material)
    return found


def states_fields(scene: Scene, section: SectionMesh, displacement: FloatArray) -> Fields:
    """What maps draw of the pre-indented state and others with those displacements (n_states, 2, n_nodes) [mm]."""
    corners = section.mesh.t.T.ravel()
    one_of = np.empty(section.mesh.nvertices, dtype=np.int64)  # of the corners at a vertex, which move together
    one_of[corners] = np.arange(corners.size)
    between = np.setdiff1d(section.interfaces(), section.receptor_facets)
    interface, receptors, boundary = (
        one_of[section.mesh.facets[:, facets].T]
        for facets in (between, section.receptor_facets, section.mesh.boundary_facets())
    )
    before, *strains = (
        maximum_principal(strain_at(scene, section.mesh, each, CORNERS).ravel()) for each in displacement
    )
    strain = np.array(strains)
    return Fields(
        corner=section.mesh.doflocs[:, corners],
        interface=interface,
        receptors=receptors,
        boundary=boundary,
        displacement=displacement[1:, :, corners],
        strain=strain,
        change=strain - before,
    )
