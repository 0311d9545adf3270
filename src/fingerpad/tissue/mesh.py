"""Mesh of the finger's section: second-order, conforming to every layer interface.

The section is meshed in logical coordinates (s, zeta): s runs along the outline from the pad's lowest point to the
dorsal mid-line, zeta from the skin (0) to the bone. Down to the finger's parallel depth zeta is the depth [mm] along
the outline's inward normal; from there to the bone it is that depth plus the fraction of the way [1]. Layer
interfaces are lines of constant zeta, so refining in logical space keeps the mesh conforming. Both halves are refined
from one grid, each for the edges as it sees them; where they see the same they are mirror images, to the last bit.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.special import ellipeinc
from skfem import ElementTriP2, MeshTri, MeshTri2

from ..arrays import FloatArray
from ..errors import MeshError
from ..scene.device import ActuatorRow
from ..scene.finger import Finger
from ..scene.numerics import Numerics
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..store import load_arrays, save_arrays
from .compliance import MIRROR

MAX_ELEMENTS = 500_000  # [1]; source: 5 GB of memory, and half as many again as the finest reference needs
MAX_REFINEMENTS = 30  # halvings of the longest edge [1]; source: 2^-30 mm is far below any size asked for
ROUNDED = 9  # decimals of a length [mm]; keeps rounding from telling equal edges apart
SIZE_SLACK = 1e-9  # relative [1]; keeps rounding from deciding whether an element is refined
LINE_SLACK = 10.0**-ROUNDED  # mm; keeps rounding from deciding on which side of a line a node lies
NODES = ElementTriP2.doflocs.T  # (2, 6) of a reference triangle [1]: corners, then midpoints of sides 0-1, 1-2, 2-0
ARC_POINTS = 4001  # of the table of arc lengths [1]; source: between them it is off by less than 1e-6 mm


@dataclass(frozen=True)
class SectionMesh:
    """Mesh of a section.

    mesh: second-order triangles; node i is column i of `mesh.doflocs` (vertices first, then edge midpoints).
    layer: (n_elements,) index into the finger's `layers`. skin: nodes on the pad's outer face, by ascending arc length.
    receptor_facets: facets on the receptor line, by ascending arc length. fixed: nodes on the bone.
    """

    mesh: MeshTri2
    layer: np.ndarray
    skin: np.ndarray
    receptor_facets: np.ndarray
    fixed: np.ndarray

    @property
    def unknowns(self) -> int:
        """Number of displacement components of all nodes."""
        return 2 * int(self.mesh.doflocs.shape[1])

    @property
    def mirrors(self) -> bool:
        """Whether the mesh is its own mirror image about x = 0, to the last bit."""
        nodes, images = self.mesh.doflocs, self.mesh.doflocs * MIRROR[:, None]
        return np.array_equal(nodes[:, np.lexsort(nodes)], images[:, np.lexsort(images)])

    def interfaces(self) -> np.ndarray:
        """Facets (k,) between two layers."""
        left, right = self.mesh.f2t
        return np.flatnonzero((right >= 0) & (self.layer[left] != self.layer[right]))


@dataclass(frozen=True)
class _Outline:
    """Logical-to-physical map of half a section."""

    finger: Finger

    @property
    def semi_axes(self) -> tuple[float, float]:
        return self.finger.width / 2.0, self.finger.height / 2.0

    def angle_of_arc(self, arc: float) -> float:
        """Angle [rad] from the dorsal top at which the outline's arc length [mm] from there is `arc`."""
        a, b = self.semi_axes
        # arc length from the end of the semi-axis b: a E(t | 1 - b^2/a^2), inverted on a table
        table = np.linspace(0.0, np.pi, ARC_POINTS)
        return float(np.interp(arc, a * ellipeinc(table, 1.0 - (b / a) ** 2), table))

    @cached_property
    def nail(self) -> float:
        """Logical coordinate s [mm] of the line on which pad and nail meet."""
        return (np.pi - self.angle_of_arc(self.finger.nail_width / 2.0)) * self.semi_axes[0]

    @cached_property
    def nail_corners(self) -> FloatArray:
        """Where layers of the nail end on that line (2, k) [mm]: its strain is singular there, as stiffness jumps."""
        depths = np.cumsum([0.0, *(layer.thickness for layer in self.finger.dorsal[:-1])])
        return self.physical(np.stack([np.full_like(depths, self.nail), depths]))

    def physical(self, logical: FloatArray) -> FloatArray:
        """Points (2, n) [mm] of logical coordinates (2, n): outline, normal offset, then straight to the bone."""
        a, b = self.semi_axes
        depth = self.finger.parallel_depth
        angle = logical[0] / a
        sin, cos = np.sin(angle), np.cos(angle)
        outline = np.array([a * sin, b - b * cos])
        normal = np.array([-b * sin, a * cos]) / np.hypot(a * cos, b * sin)
        offset = outline + np.minimum(logical[1], depth) * normal
        centre = self.finger.pad_thickness + self.finger.bone_height / 2.0
        bone = np.array(
            [self.finger.bone_width / 2.0 * sin, centre - self.finger.bone_height / 2.0 * cos],
        )
        return offset + np.maximum(logical[1] - depth, 0.0) * (bone - offset)


def mesh_section(scene: Scene, edges: FloatArray) -> SectionMesh:
    """Mesh of the finger's section, graded towards the actuators' edges and the receptor line.

    edges: (k, 2) intervals of x [mm] on the skin over which actuators' edges lie (`edges.edge_intervals`). Element
    size h [mm] (longest edge) at distance r from the nearest of them is at most edge_size + growth * max(r - edge_zone,
    0). It is at most face_size + growth * distance from the skin under the row, too, receptor_size + growth * distance
    from the receptor line, and nail_size + growth * distance from the corners of the nail's edges.

    The mesh mirrors where the row does. With small kinematics it does so for every row, and is refined under the images
    of its edges, too: the section is then condensed by halves, which saves more than these elements cost (decision 40).

    Raises MeshError if an element is inverted, more than MAX_ELEMENTS are asked for, or MAX_REFINEMENTS leave some too
    large.
    """
    row, outline = scene.device.actuators, _Outline(scene.model.finger)
    under = np.array([row.span])
    right, left = _Graded(edges, under), _Graded(-edges[:, ::-1], -under[:, ::-1])
    mirrored = row.mirrors or scene.kinematics is Kinematics.SMALL
    sides = [_both(right, left)] if mirrored else [right, left]
    halves = [_base(outline, scene.model.numerics)] * len(sides)
    for _ in range(MAX_REFINEMENTS):
        marked = [
            np.union1d(_too_large(scene, outline, half, side), _coarser_on_mid_line(half, other))
            for half, side, other in zip(halves, sides, reversed(halves), strict=True)
        ]
        if not any(each.size for each in marked):
            break
        halves = [half.refined(each) if each.size else half for half, each in zip(halves, marked, strict=True)]
        if sum(half.t.shape[1] for half in (halves[0], halves[-1])) > MAX_ELEMENTS:
            raise MeshError(
                f"{scene.device.name}: the section's mesh needs more than {MAX_ELEMENTS} elements; try thicker layers,"
                " or larger numerics.edge_size, face_size, receptor_size, nail_size or growth"
            )
    else:
        raise MeshError(f"{scene.device.name}: {MAX_REFINEMENTS} refinements leave elements larger than asked for")
    return _joined(scene, outline, halves[0], halves[-1])


def nominal_mesh(scene: Scene) -> SectionMesh:
    """`mesh_section`, fine where edges lie under undeformed skin (`nominal_edges`)."""
    return mesh_section(scene, nominal_edges(scene.device.actuators))


def save_section(path: Path, section: SectionMesh) -> None:
    """Write a section's mesh."""
    rest = {field.name: getattr(section, field.name) for field in fields(section) if field.name != "mesh"}
    save_arrays(path, {"nodes": section.mesh.doflocs, "triangles": section.mesh.t, **rest})


def load_section(path: Path) -> SectionMesh:
    """Read a section's mesh. Raises ResultError."""
    plain = "layer", "skin", "receptor_facets", "fixed"
    found = load_arrays(path, "nodes", "triangles", *plain)
    return SectionMesh(mesh=MeshTri2(found["nodes"], found["triangles"]), **{name: found[name] for name in plain})


def counterclockwise(mesh: MeshTri2) -> np.ndarray:
    """Order (n_elements, 6) of each element's NODES that goes round it counter-clockwise: corners, then midpoints."""
    return np.where(mesh.orientation()[:, None] < 0, [0, 2, 1, 5, 4, 3], np.arange(NODES.shape[1]))


def element_nodes(mesh: MeshTri2) -> np.ndarray:
    """Nodes (n_elements, 6) of the elements in that order."""
    nodes = np.vstack([mesh.t, mesh.nvertices + mesh.t2f]).T
    return np.take_along_axis(nodes, counterclockwise(mesh), axis=1)


def _base(outline: _Outline, numerics: Numerics) -> MeshTri:
    """Coarsest conforming mesh of half a section, in logical coordinates."""
    finger = outline.finger
    a, _ = outline.semi_axes
    depths = {0.0, round(finger.parallel_depth, ROUNDED)}
    for stack in (finger.pad, finger.dorsal):
        depths.update(np.round(np.cumsum([layer.thickness for layer in stack[:-1]]), ROUNDED))
    lines = np.array(sorted(depths))
    largest = numerics.largest_size / np.sqrt(2.0)  # legs of a triangle whose longest edge is the largest size
    soft = finger.pad_thickness - finger.parallel_depth
    # thin layers want columns of their own thickness, or refinement would only make their cells flatter
    thinnest = min(layer.thickness for layer in finger.pad)
    column = min(max(2.0 * thinnest, numerics.receptor_size), largest)
    along = _subdivided(np.array([0.0, outline.nail, np.pi * a]), column)
    fractions = np.linspace(0.0, 1.0, 1 + int(np.ceil(soft / largest)))[1:]
    across = np.concatenate([_subdivided(lines, largest), finger.parallel_depth + fractions])
    return MeshTri.init_tensor(along, across)


def _subdivided(lines: FloatArray, largest: float) -> FloatArray:
    """Lines with equal divisions in between, none longer than `largest` [mm]."""
    pieces = [lines[:1]]
    for start, stop in pairwise(lines):
        pieces.append(np.linspace(start, stop, 1 + int(np.ceil((stop - start) / largest)))[1:])
    return np.concatenate(pieces)


def nominal_edges(row: ActuatorRow) -> FloatArray:
    """Intervals (k, 2) of x [mm] under the rounded edges of a row, where undeformed skin lies."""
    return np.unique(np.round(np.add.outer(row.positions, row.edges).reshape(-1, 2), ROUNDED), axis=0)


@dataclass(frozen=True)
class _Graded:
    """What a half is graded towards, as that half sees it: intervals (k, 2) of x [mm] at edges, and under rows."""

    edges: FloatArray
    under: FloatArray


def _both(one: _Graded, other: _Graded) -> _Graded:
    """What a half is graded towards that stands for both."""
    pairs = (one.edges, other.edges), (one.under, other.under)
    both = (merged(np.concatenate(pair)) for pair in pairs)
    # of an interval and its image the one on the right is nearer
    return _Graded(*(intervals[intervals[:, 1] > 0.0] for intervals in both))


def merged(intervals: FloatArray) -> FloatArray:
    """Intervals (k, 2), ascending, those that overlap as one.

    >>> merged(np.array([[0.5, 2.0], [4.0, 5.0], [0.0, 1.0]]))
    array([[0., 2.],
           [4., 5.]])
    """
    found: list[list[float]] = []
    for start, stop in intervals[np.argsort(intervals[:, 0])]:
        if found and start <= found[-1][1]:
            found[-1][1] = max(found[-1][1], float(stop))
        else:
            found.append([float(start), float(stop)])
    return np.array(found)


def _too_large(scene: Scene, outline: _Outline, half: MeshTri, side: _Graded) -> np.ndarray:
    """Elements of a half, as if it were the right one, that are larger than asked for."""
    corners = outline.physical(half.p)[:, half.t]
    size = np.max(np.hypot(*(corners - np.roll(corners, 1, axis=1))), axis=0)
    wanted = _size(scene, outline, side, corners.mean(axis=1), half.p[1, half.t].mean(axis=0))
    return np.flatnonzero(size > wanted * (1.0 + SIZE_SLACK))


def _coarser_on_mid_line(half: MeshTri, other: MeshTri) -> np.ndarray:
    """Elements of a half with a side on the mid-line in whose middle the other half has a node."""
    on_line = _on_mid_line(half)[half.t]
    beside = np.flatnonzero(on_line.sum(axis=0) == 2)
    middle = np.mean(half.p[:, half.t[:, beside]], axis=1, where=on_line[:, beside])
    nodes = other.p[:, _on_mid_line(other)]
    return beside[(middle[:, :, None] == nodes[:, None]).all(axis=0).any(axis=1)]


def _on_mid_line(half: MeshTri) -> np.ndarray:
    """Which nodes of a logical half lie on the mid-line, at the pad or at the back."""
    return (half.p[0] == 0.0) | (half.p[0] == half.p[0].max())


def _size(scene: Scene, outline: _Outline, side: _Graded, centre: FloatArray, zeta: FloatArray) -> FloatArray:
    """Largest allowed element size (n,) [mm] at element centres (2, n) [mm] of logical depth zeta (n,)."""
    finger, numerics = scene.model.finger, scene.model.numerics
    start, stop = side.edges.T[..., None]
    x = np.clip(centre[0], start, stop)
    to_edge = np.min(np.hypot(centre[0] - x, centre[1] - finger.skin_height(x)), axis=0)
    first, last = side.under.T[..., None]
    depth = np.minimum(zeta, finger.parallel_depth) + np.maximum(zeta - finger.parallel_depth, 0.0) * (
        finger.pad_thickness - finger.parallel_depth
    )
    # dorsal tissue is far from the pad, however near its skin
    depth = np.where(centre[1] > finger.height / 2.0, centre[1], depth)
    beyond = np.min(np.abs(centre[0] - np.clip(centre[0], first, last)), axis=0)
    to_face = np.hypot(depth, beyond)
    to_receptors = np.hypot(depth - scene.model.receptor_depth, beyond)
    to_nail = np.min(np.hypot(*(centre[:, None] - outline.nail_corners[:, :, None])), axis=0)
    size: FloatArray = np.minimum.reduce(
        [
            np.full(depth.shape, numerics.largest_size),
            numerics.edge_size + numerics.growth * np.maximum(to_edge - numerics.edge_zone, 0.0),
            numerics.face_size + numerics.growth * to_face,
            numerics.receptor_size + numerics.growth * to_receptors,
            numerics.nail_size + numerics.growth * to_nail,
        ]
    )
    return size


def _joined(scene: Scene, outline: _Outline, right: MeshTri, left: MeshTri) -> SectionMesh:
    """The section from its logical halves, which agree on the mid-line: curved, with its layers and named lines."""
    finger = scene.model.finger
    common, beside = np.flatnonzero(_on_mid_line(right)), np.flatnonzero(~_on_mid_line(left))
    on_left = np.empty(left.p.shape[1], dtype=np.int64)  # nodes of the section that those of the left half are
    on_left[beside] = right.p.shape[1] + np.arange(beside.size)
    own = np.flatnonzero(_on_mid_line(left))
    on_left[own[np.lexsort(left.p[:, own])]] = common[np.lexsort(right.p[:, common])]
    points = np.hstack([outline.physical(right.p), outline.physical(left.p[:, beside]) * MIRROR[:, None]])
    points[0, common] = 0.0
    logical = np.hstack([right.p, left.p[:, beside]])
    mesh = MeshTri2.from_mesh(MeshTri(points, np.hstack([right.t, on_left[left.t]])))

    ends = mesh.facets
    middle = logical[:, ends].mean(axis=1)
    curved = outline.physical(middle)
    sign = np.sign(points[0, ends].sum(axis=0))
    curved[0] *= sign
    mesh = replace(mesh, doflocs=np.hstack([points, curved]))

    along = np.concatenate([logical[0], middle[0]])
    s = np.sign(mesh.doflocs[0]) * along
    zeta = np.concatenate([logical[1], middle[1]])

    layer = _layers(finger, along[mesh.t].mean(axis=0), zeta[mesh.t].mean(axis=0), outline.nail)
    depth = round(scene.model.receptor_depth, ROUNDED)
    on_pad = along <= outline.nail + LINE_SLACK
    facet_nodes = points.shape[1] + np.arange(ends.shape[1])
    level = np.all(zeta[ends] == depth, axis=0) & on_pad[facet_nodes]
    receptor_facets = np.flatnonzero(level)
    skin = np.flatnonzero((zeta == 0.0) & on_pad)
    section = SectionMesh(
        mesh=mesh,
        layer=layer,
        skin=skin[np.argsort(s[skin])],
        receptor_facets=receptor_facets[np.argsort(s[facet_nodes[receptor_facets]])],
        fixed=np.flatnonzero(zeta == zeta.max()),
    )
    require_valid(mesh, "section mesh")
    return section


def _layers(finger: Finger, s: FloatArray, zeta: FloatArray, nail: float) -> np.ndarray:
    """Index (n_elements,) into the finger's layers of elements by their logical centres."""
    # ASSUME: finger: off the mid-line, too, layers lie in their order, and the last of each stack fills up to the bone
    # ASSUME: finger.pad: interfaces between layers are smooth, without dermal papillae and intermediate ridges
    index = np.empty(s.shape, dtype=np.int64)
    first = 0
    for stack, inside in ((finger.pad, s < nail), (finger.dorsal, s > nail)):
        interfaces = np.cumsum([layer.thickness for layer in stack[:-1]])
        index[inside] = first + np.searchsorted(interfaces, zeta[inside])
        first += len(stack)
    return index


def require_valid(mesh: MeshTri2, name: str) -> None:
    """Raise MeshError if the map of any element has a non-positive Jacobian at its corners or midpoints."""
    gradient = mesh.mapping().DF(NODES)  # scikit-fem's own determinants end in an error of theirs where one is zero
    determinant = gradient[0, 0] * gradient[1, 1] - gradient[0, 1] * gradient[1, 0]
    sign = np.sign(determinant[:, :1])
    bad = np.flatnonzero(np.any(determinant * sign <= 0.0, axis=1))
    if bad.size:
        where = mesh.doflocs[:, mesh.t[0, bad[0]]]
        raise MeshError(f"{name}: {bad.size} inverted elements, the first near x, y = {where.round(3)} mm")
