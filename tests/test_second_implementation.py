"""Device 2 without friction and with small strains, computed a second time from the equations of docs/model.md by code
that shares no line with the library: another mesh of other elements, other maps, another solver, another filter.
Numbers of equations are those of the page.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.interpolate import CubicSpline
from scipy.optimize import bisect
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import SuperLU, splu
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, MeshQuad, MeshQuad2
from skfem.helpers import ddot, sym_grad, trace

from fingerpad.api import predict

ROOT = Path(__file__).parents[1]
DEVICE = ROOT / "config" / "devices" / "device2.yaml"
COARSE, FINE = 0.1, 0.01  # mm along the skin under the row, and there at the pins' edges
ZONE, GROWTH = 0.05, 0.25  # mm on both sides of an edge that are fine, and how sizes grow with the distance from there
REACHED = 4.6  # mm from the mid-line; skin beyond it touches nothing
DEEPEST = 2.2, 1.2  # mm, heights of the faces between which pre-indentation ends
GAUSS = 0.5 - 0.5 / np.sqrt(3.0)


def given(path: Path) -> Any:
    """A scene file with the values alone."""

    def plain(node: Any) -> Any:
        if isinstance(node, dict):
            return node["value"] if "value" in node else {key: plain(each) for key, each in node.items()}
        return [plain(each) for each in node] if isinstance(node, list) else node

    return plain(yaml.safe_load(path.read_text(encoding="utf-8")))


CONFIG, ROW = given(ROOT / "config" / "config.yaml"), given(DEVICE)
FINGER, FILTER = CONFIG["finger"], CONFIG["filter"]
PAD, DORSAL = FINGER["pad"], FINGER["dorsal"]
PINS = ROW["actuators"]["pitch"] * (np.arange(ROW["actuators"]["count"]) - (ROW["actuators"]["count"] - 1) / 2.0)
FLAT = ROW["actuators"]["width"] / 2.0 - ROW["actuators"]["edge_radius"]
PARALLEL = sum(layer["thickness"] for layer in PAD[:-1])
RECEPTORS = PAD[0]["thickness"] + PAD[1]["thickness"]


def place(theta: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Equations (1) and (2); depth counts on beyond PARALLEL to the bone."""
    a, b = FINGER["width"] / 2.0, FINGER["height"] / 2.0
    last = PAD[-1]["thickness"]
    height = 2.0 * b - sum(layer["thickness"] for layer in PAD + DORSAL)
    outline = np.array([a * np.sin(theta), b - b * np.cos(theta)])
    inward = np.array([-b * np.sin(theta), a * np.cos(theta)]) / np.hypot(a * np.cos(theta), b * np.sin(theta))
    bone = np.array([FINGER["bone_width"] * np.sin(theta), -height * np.cos(theta)]) / 2.0
    bone[1] += PARALLEL + last + height / 2.0
    way = np.clip((depth - PARALLEL) / last, 0.0, 1.0)
    return (1.0 - way) * (outline + np.minimum(depth, PARALLEL) * inward) + way * bone


def arc_length(theta: np.ndarray, depth: float) -> np.ndarray:
    """Arc length from the mid-line along a line of constant depth."""
    fine = np.linspace(-np.pi, np.pi, 400_001)
    steps = np.hypot(*np.diff(place(fine, np.full_like(fine, depth)), axis=1))
    length = np.interp(theta, fine, np.concatenate([[0.0], np.cumsum(steps)]))
    return length - np.interp(0.0, fine, np.concatenate([[0.0], np.cumsum(steps)]))


def columns(edges: np.ndarray) -> tuple[np.ndarray, float]:
    """Angles of the mesh's columns, fine at the edges' x, and the angle at which pad and nail meet."""
    fine = np.linspace(0.0, np.pi, 200_001)
    lengths = arc_length(fine, 0.0)
    nail = float(np.interp(lengths[-1] - FINGER["nail_width"] / 2.0, lengths, fine))
    x = FINGER["width"] / 2.0 * np.sin(fine)
    size = np.full_like(fine, COARSE)
    for edge in edges:
        size = np.minimum(size, FINE + GROWTH * np.maximum(abs(x - edge) - ZONE, 0.0))
    passed = np.concatenate([[0.0], np.cumsum(np.diff(lengths) / size[1:])])
    reached = np.interp(np.arcsin(REACHED / (FINGER["width"] / 2.0)), fine, passed)
    under = np.interp(np.linspace(0.0, reached, int(reached) + 2), passed, fine)
    right = np.concatenate([under, np.linspace(under[-1], nail, 24)[1:], np.linspace(nail, np.pi, 12)[1:]])
    return np.concatenate([-right[:0:-1], right]), nail


@dataclass(frozen=True)
class Tissue:
    """The factorised section.

    flat: its mesh over angle and depth. joined: unknowns of all nodes, at the seam twice, by those that are solved for.
    hats: (3, n) undeformed place and weight. loads: (n_solved, 2 n) forces of unit resultants, first along x, then y.
    """

    flat: MeshQuad2
    basis: Basis
    joined: csr_matrix
    factors: SuperLU
    hats: np.ndarray
    loads: csc_matrix
    nail: float


def tissue(edges: np.ndarray) -> Tissue:
    """Curved nine-node quadrilaterals, fine at the edges' x, the ring cut open at the nail and joined again; stiffness
    (5) and tractions (6).
    """
    theta, nail = columns(edges)
    first, second = PAD[0]["thickness"], RECEPTORS
    depth = np.concatenate(
        [
            first * np.linspace(0.0, 1.0, 11) ** 1.5,
            np.linspace(first, second, 4)[1:],
            np.linspace(second, PARALLEL, 13)[1:],
            np.linspace(PARALLEL, PARALLEL + PAD[-1]["thickness"], 13)[1:],
        ]
    )
    flat = MeshQuad2.from_mesh(MeshQuad.init_tensor(theta, depth))
    mesh = MeshQuad2(place(*flat.doflocs), flat.t)
    basis = Basis(mesh, ElementVector(ElementQuad2()), intorder=4)

    at, under = flat.doflocs[:, flat.t].mean(axis=1)
    moduli, ratios = np.empty(at.size), np.empty(at.size)
    for stack, there in ((PAD, abs(at) < nail), (DORSAL, abs(at) > nail)):
        bottom = np.cumsum([layer["thickness"] for layer in stack][:-1])
        which = np.digitize(under, bottom)
        moduli[there] = np.array([layer["modulus"] for layer in stack])[which[there]]
        ratios[there] = np.array([layer["poisson"] for layer in stack])[which[there]]
    shear = moduli / (2.0 * (1.0 + ratios))
    volume = 2.0 * shear * ratios / (1.0 - 2.0 * ratios)

    @BilinearForm
    def work(u: Any, v: Any, w: Any) -> Any:
        return w.volume * trace(sym_grad(u)) * trace(sym_grad(v)) + 2.0 * w.shear * ddot(sym_grad(u), sym_grad(v))

    points = np.ones(basis.X.shape[1])
    stiffness = work.assemble(basis, volume=np.outer(volume, points), shear=np.outer(shear, points))

    component = np.zeros(basis.N)
    for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
        component[dofs[1]] = 1.0
    spots = np.round(np.vstack([basis.doflocs, component]), 9) + 0.0
    _, solved = np.unique(spots, axis=1, return_inverse=True)
    on_bone = np.isclose(Basis(flat, ElementVector(ElementQuad2())).doflocs[1], depth[-1])
    free = np.unique(solved[~on_bone])
    number = np.full(solved.max() + 1, -1)
    number[free] = np.arange(free.size)
    kept = np.flatnonzero(number[solved] >= 0)
    joined = csr_matrix((np.ones(kept.size), (kept, number[solved[kept]])), shape=(basis.N, free.size))
    hats, forces = tractions(basis, flat)
    reduced = csc_matrix(joined.T @ stiffness @ joined)
    factors = splu(reduced, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return Tissue(flat, basis, joined, factors, hats, csc_matrix(joined.T @ forces), nail)


def tractions(basis: Basis, flat: MeshQuad2) -> tuple[np.ndarray, csr_matrix]:
    """Hats (3, n) of x, y and weight, and nodal forces (n_unknowns, 2 n) of unit resultants, by component: (6)."""
    skin = np.flatnonzero(np.isclose(flat.p[1, flat.facets], 0.0).all(axis=0))
    skin = skin[(abs(place(*flat.p)[0, flat.facets[:, skin]]) < REACHED).all(axis=0)]
    skin = skin[(abs(flat.p[0, flat.facets[:, skin]]) < np.pi / 2.0).all(axis=0)]
    corners = np.unique(flat.facets[:, skin])
    corners = corners[np.argsort(flat.p[0, corners])]
    x, weights = np.polynomial.legendre.leggauss(6)
    x, weights = (x + 1.0) / 2.0, weights / 2.0
    quadratic = np.array([(1.0 - x) * (1.0 - 2.0 * x), x * (2.0 * x - 1.0), 4.0 * x * (1.0 - x)])
    slopes = np.array([4.0 * x - 3.0, 4.0 * x - 1.0, 4.0 - 8.0 * x])
    hats, forces = np.zeros((3, corners.size)), np.zeros((basis.N, 2 * corners.size))
    for facet in skin:
        ends = flat.facets[:, facet]
        unknowns = np.column_stack([basis.nodal_dofs[:, ends], basis.facet_dofs[:2, facet]])
        nodes = basis.doflocs[:, unknowns[0]]
        lengths = np.hypot(*(nodes @ slopes)) * weights
        for end, hat in zip(ends, (1.0 - x, x), strict=True):
            j = int(np.flatnonzero(corners == end)[0])
            hats[:, j] += np.vstack([nodes @ quadratic, np.ones_like(x)]) @ (hat * lengths)
            for axis in (0, 1):
                forces[unknowns[axis], axis * corners.size + j] += quadratic @ (hat * lengths)
    hats[:2] /= hats[2]
    return hats, csr_matrix(forces / np.tile(hats[2], 2))


@dataclass(frozen=True)
class Contact:
    """Skin (2, n) at rest, and how pressing (n,) moves it along x and y; nearest pin of each node."""

    skin: np.ndarray
    along: np.ndarray
    up: np.ndarray
    pin: np.ndarray

    def place(self, pressing: np.ndarray, pins: np.ndarray) -> np.ndarray:
        """Where skin is from the middle of its pin's face (8)."""
        return np.asarray(self.skin[0] + self.along @ pressing - pins[self.pin])

    def height(self, pressing: np.ndarray, rise: float) -> np.ndarray:
        """How high skin is above the plane of the faces."""
        return np.asarray(self.skin[1] + self.up @ pressing - rise)

    def settled(self, pins: np.ndarray, rise: float, pressing: np.ndarray) -> np.ndarray:
        """Forces (n,) that obey (10), by a semismooth Newton method: nodes press where force exceeds gap."""
        scale = 1.0 / np.diag(self.up)
        for _ in range(200):
            below, slope = profile(self.place(pressing, pins))
            gap = self.height(pressing, rise) + below
            touching = pressing > scale * gap
            matrix = (self.up + slope[:, None] * self.along)[np.ix_(touching, touching)]
            lifted = gap - (self.up + slope[:, None] * self.along) @ pressing
            new = np.zeros_like(pressing)
            new[touching] = np.linalg.solve(matrix, -lifted[touching])
            done = np.abs(new - pressing).max() < 1e-11 * np.abs(new).max()
            pressing = new
            if done:
                return pressing
        raise AssertionError("the second implementation does not converge")

    def least_cover(self, pressing: np.ndarray, pins: np.ndarray, rise: float) -> float:
        """How far the fronts of contact, by (13), lie beyond the ends of the flat faces, at the one least far."""
        covered = []
        for pin in range(pins.size):
            own = np.flatnonzero(self.pin == pin)
            x, h = self.place(pressing, pins)[own], np.maximum(self.height(pressing, rise)[own], 0.0) ** (2.0 / 3.0)
            touching = np.flatnonzero(pressing[own] > 0.0)
            if touching.size == 0:
                return -1.0
            for last, side in ((touching[0], -1), (touching[-1], 1)):
                first, second = last + side, last + 2 * side
                step = h[first] * (x[second] - x[first]) / (h[second] - h[first]) if h[second] > h[first] else 0.0
                covered.append(max(side * x[last], side * (x[first] - step)) - FLAT)
        return float(min(covered))


def profile(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Equation (9), and its slope."""
    radius = ROW["actuators"]["edge_radius"]
    beyond = np.maximum(abs(x) - FLAT, 0.0)
    steepest = radius * np.sin(np.radians(75.0))
    on_circle = np.minimum(beyond, steepest)
    slope = on_circle / np.sqrt(radius**2 - on_circle**2)
    below = radius - np.sqrt(radius**2 - on_circle**2) + slope * (beyond - on_circle)
    return below, np.sign(x) * slope


def strain(found: Tissue, pressing: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Arc lengths, and largest principal strain (18) there, at two points of each facet under the epidermis."""
    forces = np.concatenate([np.zeros_like(pressing), pressing])
    field = found.joined @ found.factors.solve(found.loads @ forces)
    theta, under = found.flat.doflocs[:, found.flat.t].mean(axis=1)
    beneath = under[under > RECEPTORS].min()
    row = np.flatnonzero(np.isclose(under, beneath) & (abs(theta) < found.nail))
    at = np.array([[0.0, 0.0], [GAUSS, 1.0 - GAUSS]]), np.full(2, 0.5)
    read = Basis(found.basis.mesh, ElementVector(ElementQuad2()), elements=row, quadrature=at)
    theta, depth = Basis(found.flat, ElementQuad2(), elements=row, quadrature=at).global_coordinates()
    assert np.allclose(depth, RECEPTORS), "receptors are read elsewhere"
    gradient = np.moveaxis(np.asarray(read.interpolate(field).grad), (0, 1), (-2, -1))
    largest = np.linalg.eigvalsh((gradient + np.swapaxes(gradient, -1, -2)) / 2.0)[..., -1].ravel()
    s = arc_length(np.asarray(theta).ravel(), RECEPTORS)
    order = np.argsort(s)
    return s[order], np.maximum(largest, 0.0)[order]


def score(s: np.ndarray, value: np.ndarray, wavelength: float) -> float:
    """Equations (19) and (20)."""
    spacing, sigma = FILTER["spacing"] / 2.0, FILTER["sigma"]
    grid = spacing * np.arange(-int(s.max() / spacing), int(s.max() / spacing) + 1)
    x = spacing * np.arange(-int(6.0 * sigma / spacing), int(6.0 * sigma / spacing) + 1)
    gabor = np.cos(2.0 * np.pi * x / wavelength) * np.exp(-(x**2) / (2.0 * sigma**2))
    filtered = np.convolve(CubicSpline(s, value)(grid), gabor, mode="same") * spacing
    end = PINS[-1] + ROW["actuators"]["width"] / 2.0 + CONFIG["readout"]["span_margin"]
    line = np.linspace(-end, end, 20_001)
    return float(np.trapezoid(abs(CubicSpline(grid, filtered)(line)), line))


def pressed(found: Tissue) -> tuple[Contact, np.ndarray, float]:
    """Contact, forces, and how high the faces are where pre-indentation ends."""
    count = found.hats.shape[1]
    moved = np.array([found.loads.T @ found.factors.solve(load) for load in found.loads[:, count:].T.toarray()]).T
    pin = np.argmin(abs(found.hats[0][:, None] - PINS), axis=1)
    contact = Contact(found.hats[:2], moved[:count], moved[count:], pin)
    pressing = np.zeros(count)
    for rise in np.linspace(0.0, DEEPEST[0], 23)[1:]:
        pressing = contact.settled(PINS, rise, pressing)
    covered = bisect(
        lambda rise: contact.least_cover(contact.settled(PINS, rise, pressing), PINS, rise), *DEEPEST, xtol=1e-6
    )
    return contact, contact.settled(PINS, covered, pressing), float(covered)


def edges_of(contact: Contact, pressing: np.ndarray) -> np.ndarray:
    """Distances from the mid-line, at rest, of the skin that lies at the ends of flat faces."""
    owned = [np.flatnonzero(contact.pin == pin) for pin in range(PINS.size)]
    x = contact.place(pressing, PINS)
    return abs(np.concatenate([np.interp([-FLAT, FLAT], x[own], contact.skin[0][own]) for own in owned]))


def scores() -> dict[tuple[str, str], float]:
    """Scores by condition and read-out, on a mesh that is fine where a coarse one has the edges."""
    roughly, forces, _ = pressed(tissue(np.zeros(0)))
    found = tissue(edges_of(roughly, forces))
    contact, pressing, covered = pressed(found)
    s, before = strain(found, pressing)
    scored = {}
    amplitude, groups = ROW["stimulus"]["amplitude"], np.array(ROW["stimulus"]["dispersions"]["alternate"])
    for phase in ROW["stimulus"]["phases"]:
        pins = PINS + amplitude * np.cos(groups * np.radians(phase))  # (14)
        _, after = strain(found, contact.settled(pins, covered, pressing))
        scored[f"alternate_{phase:03d}", "strain"] = score(s, after, FILTER["wavelength_strain"])
        scored[f"alternate_{phase:03d}", "change_of_strain"] = score(s, after - before, FILTER["wavelength_change"])
    return scored


def test_a_second_implementation_gives_the_same_scores_within_the_stated_errors(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(ROOT)
    rows = predict(DEVICE)
    rows = rows[rows["interface"] == "frictionless"]
    found = scores()
    off = {
        (row.condition, row.readout): (found[row.condition, row.readout] - row.score) / row.score_error
        for row in rows.itertuples()
    }
    assert len(off) == len(found) == 6
    assert max(map(abs, off.values())) < 1.0, off
