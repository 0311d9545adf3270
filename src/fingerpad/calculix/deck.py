"""A scene as an input deck in Abaqus keywords, which CalculiX runs unchanged.

Of the tissue's laws, hencky is meant for Abaqus and green for CalculiX: each takes the other's for another law
(`kinematics_told`).

The deck holds the section's own second-order triangles (CPE6), the layers' materials, the bone, and the actuators:
rigid ones as elements all of whose nodes are prescribed, deformable ones as elastic strips on a prescribed base. The
first step raises the actuators to a given height, every further one plays one time of the stimulus. Units are mm, N
and MPa; the thickness is 1 mm, so that forces are per mm.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from skfem import MeshTri2

from ..arrays import FloatArray
from ..contact.profile import WALL_ANGLE, profile
from ..errors import SceneError
from ..scene.device import ActuatorRow, Body, Condition
from ..scene.finger import Layer, Material
from ..scene.numerics import Numerics
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics, Law, TissueLaw
from ..tissue.elasticity import lame, mesh_dofs
from ..tissue.mesh import SectionMesh, element_nodes
from ..tissue.reach import contact_tractions
from ..tissue.receptors import receptor_strain
from ..tissue.strip import mesh_strip
from ..words import plain

ARC_STEP = np.deg2rad(5.0)  # rad; angle of a rigid edge's one element; source: its chord is 1e-3 radii off
FACE_STEP = 0.1  # mm; length of an element on a rigid flat face, which any length describes exactly
WALL_LENGTH = 2.0  # edge radii [1]; how far the wall beyond a rigid edge goes on: the skin does not get there
RIGID_DEPTH = 0.5  # mm; of a rigid actuator's elements, which only carry their surface
EDGE_ELEMENTS = 8  # of a deformable actuator along the radius of its edge [1]; source: assumption: 7 degrees an element
# any finite values will do: every node of a rigid actuator is prescribed
RIGID = Material(2.0e5, 0.3)  # MPa, 1; source: steel
LARGEST_COUNT = 100000  # increments [1] that a step may take, and after which it writes: only at its end
SMALLEST_INCREMENT = 1.0e-6  # of a step [1]; source: assumption: a thousandth of any increment that was needed
PER_LINE = 8  # numbers a data line [1]; source: Abaqus allows 16
READ_NODES = "RECEPTOR_NODES"
FRICTIONLESS = 1.0e-8  # friction [1] of a contact whose friction is switched on later: the keyword needs a positive one


@dataclass(frozen=True)
class DeckSettings:
    """How a deck indents, holds contact and divides its steps.

    height: of the faces above the pad's lowest point after pre-indentation [mm]. friction_indenting, friction_acting:
    during pre-indentation and during the stimulus [1]. pressure_slope, stick_slope: penalties [MPa/mm], pressure over
    penetration and shear over elastic slip. indentation_increments, stimulus_increments: increments of a step [1].
    rest_increments: of a step at rest after each of them, or none [1]: CalculiX looks only at the start of an increment
    where the surfaces face each other, and in which direction.

    Raises SceneError if a slope or a number of increments is not positive, another number negative or not finite, or
    friction falls after pre-indentation.
    """

    height: float
    friction_indenting: float
    friction_acting: float
    pressure_slope: float
    stick_slope: float
    indentation_increments: int
    stimulus_increments: int
    rest_increments: int

    def __post_init__(self) -> None:
        for name in ("pressure_slope", "stick_slope", "indentation_increments", "stimulus_increments"):
            if not 0 < getattr(self, name) < math.inf:
                raise SceneError(f"deck: {plain(name)} must be positive and finite, found {getattr(self, name)}")
        for name in ("height", "friction_indenting", "friction_acting", "rest_increments"):
            if not 0 <= getattr(self, name) < math.inf:
                raise SceneError(f"deck: {plain(name)} must be finite and not negative, found {getattr(self, name)}")
        if self.friction_acting < self.friction_indenting:
            raise SceneError(
                f"deck: friction that indents must act too, found {self.friction_indenting:g}, and"
                f" {self.friction_acting:g} during the stimulus"
            )

    @property
    def steps_a_move(self) -> int:
        """Steps [1] of each move of the actuators: the move, and the rest after it if there is one."""
        return 2 if self.rest_increments else 1


@dataclass(frozen=True)
class _Part:
    """Elements of one actuator: kind, nodes (n, 2) [mm], elements (m, k), touching (element, side), driven nodes."""

    name: str
    kind: str
    node: FloatArray
    element: np.ndarray
    touching: list[tuple[int, int]]
    driven: np.ndarray
    material: Material


def input_deck(scene: Scene, section: SectionMesh, condition: Condition, settings: DeckSettings) -> str:
    """The whole deck of one condition. Raises SceneError if decks do not have the actuators' kind, MeshError as
    `mesh_strip` and `contact_tractions`.
    """
    first_node, first_element = section.mesh.doflocs.shape[1], section.mesh.t.shape[1]
    parts = [_part(scene, number) for number in range(len(scene.device.actuators.positions))]
    lines = [*_heading(scene, condition, settings), *_finger(scene, section)]
    for part in parts:
        lines += _actuator(part, first_node, first_element)
        first_node += part.node.shape[0]
        first_element += part.element.shape[0]
    lines += _materials(scene, parts[0])
    lines += _contact(scene, settings)
    lines += _steps(scene, condition, settings)
    return "\n".join(lines) + "\n"


def actuator_name(number: int) -> str:
    """Name of an actuator's set of prescribed nodes, by its index in the row."""
    return f"ACTUATOR_{number + 1}"


def read_nodes(scene: Scene, section: SectionMesh) -> np.ndarray:
    """Nodes (k,) whose displacement decides the strain at the receptors, on the side that the scene reads."""
    _, strain = receptor_strain(section, scene)
    return np.flatnonzero(np.isin(mesh_dofs(section.mesh), strain.indices).any(axis=0))


def _part(scene: Scene, number: int) -> _Part:
    """Elements of the actuator of that index, its face at y = 0."""
    row = scene.device.actuators
    name, centre = actuator_name(number), row.positions[number]
    if row.body is None:
        return _rigid(name, row, centre)
    if type(row.body) is not Body:
        raise SceneError(
            f"deck: found actuators of the kind {type(row.body).__name__}; allowed: rigid and deformable ones"
        )
    return _strip(name, row, scene.model.numerics, centre, row.body.material)


def _rigid(name: str, row: ActuatorRow, centre: float) -> _Part:
    """One row of second-order quadrilaterals under the profile, all prescribed; a sharp edge ends the surface."""
    radius = row.edge_radius
    flat = row.width / 2.0 - radius
    x = np.linspace(-flat, flat, 1 + 2 * int(np.ceil(2.0 * flat / FACE_STEP)))
    if radius > 0.0:
        count = int(np.ceil(WALL_ANGLE / ARC_STEP))
        arc = flat + radius * np.sin(np.linspace(0.0, WALL_ANGLE, 1 + 2 * count))  # ends and middles of elements
        wall = arc[-1] + WALL_LENGTH * radius * np.cos(WALL_ANGLE) * np.array([0.5, 1.0])
        right = np.concatenate([arc[1:], wall])
        x = np.concatenate([-right[::-1], x, right])
    top = np.stack([x, -profile(row, x)[0] if radius > 0.0 else np.zeros_like(x)])
    bottom = top - np.array([[0.0], [RIGID_DEPTH]])
    middle = (top + bottom)[:, ::2] / 2.0
    count = x.size
    element = np.arange(0, count - 2, 2)
    corner = 2 * count + element // 2
    connectivity = np.stack(
        [
            *(count + element, count + element + 2, element + 2, element),
            *(count + element + 1, corner + 1, element + 1, corner),
        ],
        axis=1,
    )
    node = np.hstack([top, bottom, middle]).T + np.array([centre, 0.0])
    touching = [(k, 3) for k in range(element.size)]  # side 3 of a CPE8 joins its corners 3 and 4
    return _Part(
        name=name,
        kind="CPE8",
        node=node,
        element=connectivity,
        touching=touching,
        driven=np.arange(node.shape[0]),
        material=RIGID,
    )


def _strip(name: str, row: ActuatorRow, numerics: Numerics, centre: float, material: Material) -> _Part:
    """A deformable strip whose face is lowered to the profile; its base is prescribed."""
    edge_size = min(numerics.edge_size, row.edge_radius / EDGE_ELEMENTS) if row.edge_radius else numerics.edge_size
    mesh = mesh_strip(row, replace(numerics, edge_size=edge_size))
    x, y = mesh.doflocs
    thickness = -float(y.min())
    deepest = float(profile(row, np.array([row.width / 2.0]))[0][0])
    if deepest >= thickness:
        raise SceneError(
            f"deck: found rounded edges {deepest:.2g} mm deep on a deformable body {thickness:g} mm thick; allowed:"
            " less deep than it is thick (a smaller actuators.edge_radius, or a larger actuators.body.thickness)"
        )
    # ASSUME: actuators.edge_radius: under its rounded edges the body is as much thinner as its face is lower
    lowered = y - profile(row, x)[0] * (y + thickness) / thickness
    node = np.stack([x + centre, lowered], axis=1)
    outer = (y == y.max()) | (np.abs(x) == x.max())
    return _Part(
        name=name,
        kind="CPE6",
        node=node,
        element=element_nodes(mesh),
        touching=_sides_of(mesh, boundary_facets(mesh, np.flatnonzero(outer))),
        driven=np.flatnonzero(y == y.min()),
        material=material,
    )


def boundary_facets(mesh: MeshTri2, nodes: np.ndarray) -> np.ndarray:
    """Boundary facets (k,) whose three nodes are all among `nodes`."""
    facets = mesh.boundary_facets()
    whole = np.isin(mesh.facets[:, facets], nodes).all(axis=0) & np.isin(mesh.nvertices + facets, nodes)
    return facets[whole]


def _sides_of(mesh: MeshTri2, facets: np.ndarray) -> list[tuple[int, int]]:
    """Element and side (1-3) of every boundary facet (k,)."""
    elements = mesh.f2t[0, facets]
    sides = np.argmax(element_nodes(mesh)[elements, 3:] == (mesh.nvertices + facets)[:, None], axis=1) + 1
    return list(zip(elements.tolist(), sides.tolist(), strict=True))


def _heading(scene: Scene, condition: Condition, settings: DeckSettings) -> list[str]:
    return [
        "*HEADING",
        f"Made by fingerpad: {scene.device.title}; condition {condition.name}",  # a title may begin with an asterisk
        f"** Units: mm, N, MPa. Plane strain, thickness 1 mm: forces are per mm. {kinematics_told(scene.model.tissue)}",
        "** x runs along the row of actuators, y into the finger; the pad's lowest point is the origin.",
        f"** Friction: pre-indentation {settings.friction_indenting:g}, stimulus {settings.friction_acting:g}.",
        f"** Penalties: pressure over penetration {settings.pressure_slope:g} MPa/mm, shear over elastic slip"
        f" {settings.stick_slope:g} MPa/mm.",
    ]


def kinematics_told(tissue: TissueLaw) -> str:
    """What the deck says of strains and of the law that a solver takes the finger's materials for."""
    if tissue.kinematics is Kinematics.SMALL:
        return "Small strains (no NLGEOM)."
    if tissue.law is Law.HENCKY:
        return "Large strains (NLGEOM), law hencky: Abaqus alone takes *ELASTIC in logarithmic strain."
    if tissue.law is Law.GREEN:
        return "Large strains (NLGEOM), law green: CalculiX alone takes *ELASTIC in Green's strain."
    return f"Large strains (NLGEOM), law {tissue.law}."


def _finger(scene: Scene, section: SectionMesh) -> list[str]:
    finger = scene.model.finger
    lines = ["**", "** ---- the finger: nodes [mm] and second-order plane-strain triangles, layer by layer", "*NODE"]
    lines += _nodes(section.mesh.doflocs.T, 0)
    connectivity = element_nodes(section.mesh)
    layers = finger.layers
    for index, layer in enumerate(layers):
        members = np.flatnonzero(section.layer == index)
        lines.append(f"*ELEMENT, TYPE=CPE6, ELSET={_layer_name(index, layer)}")
        lines += _elements(connectivity[members], members, 0)
    lines += ["** the rigid bone's outline", *_set("NSET", "BONE", section.fixed + 1)]
    lines += [
        "** nodes of the elements in which the receptors' strain is read",
        *_set("NSET", READ_NODES, read_nodes(scene, section) + 1),
    ]
    near = boundary_facets(section.mesh, contact_tractions(section, scene).nodes)
    nearest = scene.device.actuators.nearest(section.mesh.doflocs[0, section.mesh.nvertices + near])  # by their middles
    for number in range(len(scene.device.actuators.positions)):
        lines.append(f"** skin that actuator {number + 1} may touch")
        lines += _surface(_skin_name(number), _sides_of(section.mesh, near[nearest == number]), 0)
    return lines


def _actuator(part: _Part, first_node: int, first_element: int) -> list[str]:
    what = "rigid: every node is prescribed" if part.material is RIGID else "elastic: its base is prescribed"
    members = np.arange(part.element.shape[0])
    return [
        "**",
        f"** ---- {part.name}, {what}",
        "*NODE",
        *_nodes(part.node, first_node),
        f"*ELEMENT, TYPE={part.kind}, ELSET={part.name}_BODY",
        *_elements(part.element + first_node, members, first_element),
        *_set("NSET", part.name, part.driven + first_node + 1),
        *_surface(f"{part.name}_FACE", part.touching, first_element),
    ]


def _materials(scene: Scene, part: _Part) -> list[str]:
    finger, row = scene.model.finger, scene.device.actuators
    lines = [
        "**",
        "** ---- materials: *ELASTIC Young's modulus [MPa], Poisson's ratio [1]; NEO HOOKE C10 [MPa], D1 [1/MPa];",
        "** OGDEN mu [MPa], alpha [1], D1 [1/MPa]; sections: thickness [mm]",
    ]
    for index, layer in enumerate(finger.layers):
        name = _layer_name(index, layer)
        # nail and nail bed hardly strain; CalculiX finds no equilibrium where such stiff tissue has the law of Ogden
        soft = index < len(finger.pad)
        lines += [f"*MATERIAL, NAME={name}"]
        lines += material_lines(layer.material, scene.model.tissue) if soft else _elastic(layer.material)
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL={name}", "1.0"]
    lines += ["*MATERIAL, NAME=ACTUATOR", *_elastic(part.material)]
    for number in range(len(row.positions)):
        lines += [f"*SOLID SECTION, ELSET={actuator_name(number)}_BODY, MATERIAL=ACTUATOR", "1.0"]
    return lines


def _contact(scene: Scene, settings: DeckSettings) -> list[str]:
    lines = [
        "**",
        "** ---- contact: pressure [MPa] = slope [MPa/mm] x penetration; Coulomb friction [1], stick slope [MPa/mm]",
        "** Abaqus reads the stick slope as a slip rate: set SLIP TOLERANCE or ELASTIC SLIP on every *FRICTION there",
        "*SURFACE INTERACTION, NAME=SKIN_ON_ACTUATOR",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        f"{settings.pressure_slope:.12g}",
    ]
    if settings.friction_acting > 0.0:
        lines += _friction(max(settings.friction_indenting, FRICTIONLESS), settings)
    for number in range(len(scene.device.actuators.positions)):
        lines += [
            "*CONTACT PAIR, INTERACTION=SKIN_ON_ACTUATOR, TYPE=SURFACE TO SURFACE",
            f"{_skin_name(number)}, {actuator_name(number)}_FACE",
        ]
    return [*lines, "*BOUNDARY", "BONE, 1, 2, 0.0"]


def _steps(scene: Scene, condition: Condition, settings: DeckSettings) -> list[str]:
    count = len(scene.device.actuators.positions)
    moves = [("pre-indentation", [(0.0, settings.height)] * count)]
    for time, displaced in zip(condition.time, condition.moves.tolist(), strict=True):
        moves.append((f"stimulus at time {time:g}", [(x, settings.height + y) for x, y in displaced]))
    switched = settings.friction_acting != settings.friction_indenting
    switch = ["*CHANGE FRICTION, INTERACTION=SKIN_ON_ACTUATOR", *_friction(settings.friction_acting, settings)]
    step = f"*STEP{', NLGEOM' if scene.kinematics is Kinematics.FINITE else ''}, INC={LARGEST_COUNT}"
    # in the first step CalculiX takes overlap for a misfit of the parts, which comes to bear as the step goes on
    lines = _step("nothing moves in the first step", step, [(0.0, 0.0)] * count, 1, [], [])
    for number, (title, move) in enumerate(moves):
        increments = settings.stimulus_increments if number else settings.indentation_increments
        change = switch if switched and number == 1 else []
        lines += _step(title, step, move, increments, change, _output(count))
        if settings.rest_increments:
            lines += _step(f"at rest after {title}", step, move, settings.rest_increments, [], _output(count))
    return lines


def _friction(coefficient: float, settings: DeckSettings) -> list[str]:
    return ["*FRICTION", f"{coefficient:.12g}, {settings.stick_slope:.12g}"]


def _step(
    title: str,
    step: str,
    displacement: Sequence[tuple[float, float]],
    increments: int,
    change: list[str],
    output: list[str],
) -> list[str]:
    """One static step in equal increments: displacement (x, y) [mm] of every actuator from its place in the row; lines
    that change friction, which follow the procedure, as Abaqus wants that first; and the output at its end.
    """
    length = f"{1.0 / increments:.9g}"
    return [
        *("**", f"** ---- {title}: displacement [mm] of the actuators from their place in the row and y = 0"),
        *(step, "*STATIC", f"{length}, 1.0, {SMALLEST_INCREMENT:g}, {length}", *change),
        "*BOUNDARY",
        *(
            f"{actuator_name(number)}, {axis}, {axis}, {value:.9e}"
            for number, move in enumerate(displacement)
            for axis, value in enumerate(move, start=1)
        ),
        *output,
        "*END STEP",
    ]


def _output(actuators: int) -> list[str]:
    """What is written at the end of a step: tables of displacement and forces, fields of the whole section."""
    end = f"FREQUENCY={LARGEST_COUNT}"
    return [
        *(f"*NODE PRINT, NSET={READ_NODES}, {end}", "U"),
        *(
            line
            for number in range(actuators)
            for line in (f"*NODE PRINT, NSET={actuator_name(number)}, TOTALS=YES, {end}", "RF")
        ),
        *(f"*NODE FILE, {end}", "U, RF"),
        *(f"*EL FILE, {end}", "S, E"),
        *(f"*CONTACT FILE, {end}", "CDISP, CSTRESS"),
    ]


def material_lines(material: Material, tissue: TissueLaw) -> list[str]:
    """A material with the tissue's law. Abaqus and CalculiX take its constants in the stored energies
    C10 (I1 - 3) + (J - 1)^2/D1,    2 mu/alpha^2 (sum of stretches^alpha - 3) + (J - 1)^2/D1,
    the first terms of isochoric stretches.
    """
    if tissue.kinematics is Kinematics.SMALL or tissue.law in (Law.GREEN, Law.HENCKY):
        return _elastic(material)
    lam, mu = lame(material)
    softness = 2.0 / (lam + 2.0 * mu / 3.0)  # D1, twice the bulk modulus's inverse
    if tissue.law is Law.NEO_HOOKEAN:
        return ["*HYPERELASTIC, NEO HOOKE", f"{mu / 2.0:.12g}, {softness:.12g}"]
    return ["*HYPERELASTIC, OGDEN, N=1", f"{mu:.12g}, {tissue.ogden_exponent:.12g}, {softness:.12g}"]


def _elastic(material: Material) -> list[str]:
    return ["*ELASTIC", f"{material.modulus:.12g}, {material.poisson:.12g}"]


def _layer_name(index: int, layer: Layer) -> str:
    return f"LAYER_{index + 1}_{layer.name.upper()}"


def _skin_name(number: int) -> str:
    return f"SKIN_{number + 1}"


def _nodes(node: FloatArray, first: int) -> Iterator[str]:
    return (f"{first + k}, {x:.12e}, {y:.12e}" for k, (x, y) in enumerate(node.tolist(), start=1))


def _elements(connectivity: np.ndarray, numbers: np.ndarray, first: int) -> Iterator[str]:
    """Element lines; connectivity counts nodes from zero, and so do the elements' numbers."""
    return (
        ", ".join(map(str, [first + number + 1, *(node + 1 for node in nodes)]))
        for number, nodes in zip(numbers.tolist(), connectivity.tolist(), strict=True)
    )


def _set(keyword: str, name: str, members: Iterable[int]) -> list[str]:
    numbers = [str(int(member)) for member in members]
    return [
        f"*{keyword}, {keyword}={name}",
        *(", ".join(numbers[k : k + PER_LINE]) for k in range(0, len(numbers), PER_LINE)),
    ]


def _surface(name: str, sides: list[tuple[int, int]], first: int) -> list[str]:
    return [f"*SURFACE, NAME={name}, TYPE=ELEMENT", *(f"{first + element + 1}, S{side}" for element, side in sides)]
