"""CalculiX beside fingerpad: both agree on small cases, by what it printed of decks that are recorded, too; where it is
installed it prints that.
"""

from __future__ import annotations

import csv
import gzip
import os
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from skfem import MeshTri, MeshTri2

from fingerpad.arrays import FloatArray
from fingerpad.calculix.both_sides import BothSides
from fingerpad.calculix.case import Case, ContactModel, case_of
from fingerpad.calculix.crosscheck import (
    Outcome,
    calculix_outcome,
    deck_inputs,
    differences,
    fingerpad_outcome,
    on_deck,
    printed_outcome,
    sharpened,
)
from fingerpad.calculix.deck import DeckSettings, input_deck, material_lines
from fingerpad.calculix.deformed_crosscheck import deformed_outcome
from fingerpad.calculix.order_check import order_rows
from fingerpad.calculix.program import PROGRAM, installed
from fingerpad.calculix.run import Printed, read_printed, run
from fingerpad.errors import CalculixError, ContactError
from fingerpad.finite.deformation import elements_of, internal_force
from fingerpad.finite.hyperelasticity import tissue_of
from fingerpad.prediction.edges import mesh_device
from fingerpad.scene.contact_law import FrictionFrom
from fingerpad.scene.device import Condition
from fingerpad.scene.finger import Material
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics, Law, TissueLaw
from fingerpad.store import load
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.elasticity import displacement_basis, node_dofs
from fingerpad.tissue.mesh import SectionMesh, element_nodes, mesh_section, nominal_edges, nominal_mesh
from scenes import CONFIG, scene
from scripts import calculix_condition, calculix_orders
from scripts.calculix import main

SETTINGS = DeckSettings(
    height=0.4,
    friction_indenting=0.0,
    friction_acting=0.0,
    pressure_slope=500.0,
    stick_slope=100.0,
    indentation_increments=2,
    stimulus_increments=1,
    rest_increments=2,
)
PRINTED = """
 displacements (vx,vy,vz) for set RECEPTOR_NODES and time  {time}

         4  1.500000E-01 -2.500000E-01  0.000000E+00
        12  {value} -4.500000E-01  0.000000E+00

 forces (fx,fy,fz) for set ACTUATOR_1 and time  {time}

       101  9.000000E+00  9.000000E+00  9.000000E+00

 total force (fx,fy,fz) for set ACTUATOR_1 and time  {time}

        1.000000E-03  {value}  0.000000E+00
"""
LAWS = [Law.GREEN, Law.NEO_HOOKEAN, Law.OGDEN]  # that CalculiX has
MATERIAL, EXPONENT = Material(0.08, 0.48), 9.0
EXPECTED = Path(__file__).with_name("expected")
NUMBER = re.compile(r"-?\d+\.\d*(?:e[+-]\d+)?", re.IGNORECASE)  # with a point: others count nodes and elements
needs_calculix = pytest.mark.skipif(not installed(), reason="not installed: ccx (Debian: calculix-ccx)")


def printed(tmp_path: Path, values: list[float]) -> Path:
    path = tmp_path / "scene.dat"
    path.write_text("".join(PRINTED.format(time=f"{k}.0", value=value) for k, value in enumerate(values, start=1)))
    return path


def test_printed_tables_are_read(tmp_path: Path) -> None:
    found = read_printed(printed(tmp_path, [1.0, 2.0]), 1, 2, replace(SETTINGS, rest_increments=0))
    assert found.node.tolist() == [3, 11]
    assert found.displacement.tolist() == [[[0.15, -0.25], [value, -0.45]] for value in (1.0, 2.0)]
    assert found.force.tolist() == [[[0.001, value]] for value in (1.0, 2.0)]


def test_of_a_move_and_its_rest_the_rest_is_read(tmp_path: Path) -> None:
    found = read_printed(printed(tmp_path, [1.0, 2.0, 3.0, 4.0]), 1, 2, SETTINGS)
    assert found.force[:, 0, 1].tolist() == [2.0, 4.0]


def test_a_case_takes_no_word_or_setting_that_it_does_not_know() -> None:
    """Which would be solved for hours as another case."""
    known = {"kinematics": "small", "indentation": "full", "indentation_increments": 8}
    known |= {"coarsening": 4.0, "fingerpad_coarsening": 4.0}
    assert case_of(known | {"edges": "sharp", "law": "green"}).law is Law.GREEN
    for wrong in ({"edges": "shrp"}, {"friction_from": "always"}, {"kinematics": "large"}, {"law": "linear"}):
        with pytest.raises(ValueError, match="is not a valid"):
            case_of(known | wrong)
    with pytest.raises(TypeError, match="coarsness"):
        case_of(known | {"coarsness": 2.0})


def test_a_missing_step_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(CalculixError, match="1 tables of RECEPTOR_NODES, expected 2"):
        read_printed(printed(tmp_path, [1.0]), 1, 2, replace(SETTINGS, rest_increments=0))


def test_a_number_that_fortran_cuts_is_an_error(tmp_path: Path) -> None:
    path = printed(tmp_path, [1.0, 2.0])
    path.write_text(path.read_text().replace("1.500000E-01", "1.500000-101"))
    with pytest.raises(CalculixError, match=r"scene\.dat: displacements of RECEPTOR_NODES: "):
        read_printed(path, 1, 2, replace(SETTINGS, rest_increments=0))


def test_without_calculix_running_a_deck_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CalculixError, match="found no program ccx"):
        run("*HEADING\n", tmp_path / "deck", 1.0)


def test_without_calculix_the_table_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    table, device = tmp_path / "calculix.csv", CONFIG / "devices" / "device2.yaml"
    main(CONFIG / "config.yaml", device, "alternate_180", {}, 1.0, tmp_path / "decks", table)
    with table.open(encoding="utf-8") as file:
        assert list(csv.DictReader(file)) == [{"note": "skipped: ccx not installed"}]
    assert (tmp_path / "decks").is_dir()


def test_without_calculix_the_table_of_orders_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    device, scores, table = CONFIG / "devices" / "device2.yaml", tmp_path / "scores.csv", tmp_path / "orders.csv"
    calculix_condition.main(CONFIG / "config.yaml", device, "alternate_180", {}, 1.0, tmp_path / "deck", scores)
    calculix_orders.main([scores], table)
    assert table.read_text(encoding="utf-8") == "note\nskipped: ccx not installed\n"
    assert (tmp_path / "deck").is_dir()


def test_orders_have_the_scores_of_both_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    """And a note in place of those that a program does not find."""
    arc, scores = np.linspace(0.0, 1.0, 5), dict.fromkeys(Readout, 0.123456)
    outcome = Outcome(arc, np.ones((2, 5)), np.ones((2, 3, 2)), scores)

    def lost(contact: ContactModel) -> Outcome:
        raise ContactError(f"{contact} is lost")

    case = Case(Kinematics.SMALL, 1.0, 8, 1.0, 1.0)
    found = [BothSides(outcome, lambda contact: outcome, 9, 1.0), BothSides(outcome, lost, 9, 1.0)]
    monkeypatch.setattr("fingerpad.calculix.order_check.both_sides", lambda *given: found.pop(0))
    both, one = (order_rows(scene("device2"), "alternate_180", case, Path(), 1.0) for _ in range(2))
    assert [(row["readout"], row["fingerpad"], row["calculix"], row["note"]) for row in both] == [
        (readout, "0.12346", "0.12346", "") for readout in Readout
    ]
    assert [(row["fingerpad"], row["calculix"], row["note"]) for row in one] == 2 * [
        ("", "0.12346", "fingerpad is lost")
    ]


@needs_calculix
def test_a_deck_that_calculix_refuses_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(CalculixError, match="failed"):
        run("*NODE\n1, 0., 0.\n*STEP\n*STATIC\n*NONSENSE\n*END STEP\n", tmp_path, 60.0)


def finite(a_scene: Scene, law: Law) -> Scene:
    tissue = replace(a_scene.model.tissue, kinematics=Kinematics.FINITE, law=law)
    return a_scene.with_model(tissue=tissue)


@dataclass(frozen=True)
class Decked:
    """A scene on a coarse mesh, and the deck that it is written as."""

    scene: Scene
    section: SectionMesh
    settings: DeckSettings

    @property
    def condition(self) -> Condition:
        return self.scene.device.condition("alternate_000")

    @property
    def deck(self) -> str:
        return input_deck(self.scene, self.section, self.condition, self.settings)


def small_case() -> Decked:
    """Nodes are 0.1 mm apart on faces 1 mm wide."""
    small = on_deck(sharpened(scene("device2")), 4.0)
    small = small.with_model(numerics=replace(small.model.numerics, growth=0.8, nail_size=2.0, largest_size=2.0))
    return Decked(small, mesh_device(small), SETTINGS)


def large_case() -> Decked:
    """Nodes are half as far apart, strains are large."""
    large = finite(on_deck(sharpened(scene("device2")), 2.0), Law.NEO_HOOKEAN)
    sizes = {"growth": 1.2, "receptor_size": 0.6, "nail_size": 3.0, "largest_size": 3.0}
    large = large.with_model(numerics=replace(large.model.numerics, **sizes))
    return Decked(large, nominal_mesh(large), replace(SETTINGS, height=0.8))


CASES = {"small": small_case, "finite": large_case}


def printed_of(name: str) -> Printed:
    """What CalculiX printed of a case."""
    return load(EXPECTED / f"calculix_{name}.npz", Printed)


def test_calculix_agrees_on_a_small_frictionless_case() -> None:
    """Where contact ends is uncertain by 5 % of a face.

    The edges of a face are at fault in turn, and strain lies 0.6 mm deep: less than half of it is left there. Total
    forces do not feel it but in the second order.
    """
    case = small_case()
    reference = printed_outcome(case.scene, case.section, printed_of("small"))
    condensed = condense_section(case.section, case.scene)
    found = fingerpad_outcome(case.scene, condensed, None, case.condition, case.settings, ContactModel.PENALTIES)
    apart = differences(found, reference)
    assert apart["pressing_indented"] < 0.05**2
    assert apart["strain_indented"] < 0.02
    assert np.allclose(reference.force[0, :, 0].sum(), 0.0, atol=1e-6 * reference.force[0, :, 1].sum())


def test_calculix_agrees_on_a_small_case_of_large_strains() -> None:
    """Nodes are half as far apart as in the case of small strains, so half of its differences are allowed."""
    case = large_case()
    reference = printed_outcome(case.scene, case.section, printed_of("finite"))
    found = deformed_outcome(case.scene, case.section, None, case.condition, case.settings, ContactModel.PENALTIES)
    apart = differences(found, reference)
    assert apart["pressing_indented"] < 0.005
    assert apart["strain_indented"] < 0.01


DECKS = {
    **{name: lambda case=case: case().deck for name, case in CASES.items()},
    **{f"law_{law}": lambda law=law: law_deck(law) for law in LAWS},
}


@pytest.mark.parametrize("name", DECKS)
def test_what_is_recorded_was_printed_of_these_decks(name: str) -> None:
    """Line by line, up to the rounding of coordinates. If a deck is meant to change, it is recorded with what CalculiX
    prints of it.
    """
    deck, recorded = DECKS[name](), gzip.decompress((EXPECTED / f"calculix_{name}.inp.gz").read_bytes()).decode()
    assert NUMBER.sub("#", deck) == NUMBER.sub("#", recorded)
    found, expected = (np.array(NUMBER.findall(text), dtype=float) for text in (deck, recorded))
    assert np.allclose(found, expected, rtol=1e-9, atol=1e-9)  # of mm, N and MPa; ten digits are written


@needs_calculix
@pytest.mark.parametrize("name", CASES)
def test_calculix_prints_of_decks_what_is_recorded(name: str, tmp_path: Path) -> None:
    """If a deck is meant to change: fingerpad.store.save what is printed over the recorded file. Another build of
    CalculiX rounds otherwise, and prints seven digits.
    """
    case, recorded = CASES[name](), printed_of(name)
    table, _ = run(case.deck, tmp_path, 300.0)
    found = read_printed(table, len(case.scene.device.actuators.positions), 2, case.settings)
    assert found.node.tolist() == recorded.node.tolist()
    for one, other in ((found.displacement, recorded.displacement), (found.force, recorded.force)):
        assert np.allclose(one, other, rtol=0.0, atol=1e-5 * np.abs(other).max())


def sheared(mesh: MeshTri2) -> FloatArray:
    """Displacement (2, n_nodes) that shears, presses by a third and bends."""
    place = mesh.doflocs
    return np.array([[0.3, 0.25], [-0.1, -0.3]]) @ place + 0.05 * np.array([place[1] ** 2, place[0] * place[1]])


@pytest.mark.parametrize("law", LAWS)
def test_laws_are_those_of_calculix(law: Law) -> None:
    """Nodal forces of four elements that are sheared, up to the digits that CalculiX printed of its own."""
    mesh = MeshTri2.from_mesh(MeshTri.init_symmetric())
    basis = displacement_basis(mesh)
    points = tissue_of(law, EXPONENT, [MATERIAL], np.zeros((mesh.nelements, 1), dtype=int))
    displacement, dofs = np.empty(basis.N), node_dofs(basis)
    displacement[dofs] = sheared(mesh)
    force = internal_force(elements_of(basis, points, np.arange(basis.N)), displacement)[dofs]
    assert np.allclose(force, recorded(law), rtol=0.0, atol=1e-6 * np.abs(force).max())


def recorded(law: Law) -> FloatArray:
    """Reactions (2, n_nodes) [N/mm] that CalculiX printed, by node."""
    with (EXPECTED / "calculix_laws.csv").open(encoding="utf-8") as file:
        return np.array([[row["fx"], row["fy"]] for row in csv.DictReader(file) if row["law"] == law], dtype=float).T


def law_deck(law: Law) -> str:
    """The four elements with that law, sheared."""
    mesh = MeshTri2.from_mesh(MeshTri.init_symmetric())
    place, moved = mesh.doflocs, sheared(mesh)
    tissue = TissueLaw(Kinematics.FINITE, (Kinematics.FINITE,), law, EXPONENT)
    numbers = range(1, place.shape[1] + 1)
    deck = [
        "*NODE, NSET=ALL",
        *(f"{n}, {x:.12e}, {y:.12e}" for n, (x, y) in zip(numbers, place.T, strict=True)),
        "*ELEMENT, TYPE=CPE6, ELSET=PATCH",
        *(", ".join(map(str, [k, *nodes])) for k, nodes in enumerate((element_nodes(mesh) + 1).tolist(), start=1)),
        *("*MATERIAL, NAME=TISSUE", *material_lines(MATERIAL, tissue)),
        *("*SOLID SECTION, ELSET=PATCH, MATERIAL=TISSUE", "1.0", "*STEP, NLGEOM", "*STATIC", "1.0, 1.0", "*BOUNDARY"),
        *(f"{n}, {axis}, {axis}, {moved[axis - 1, n - 1]:.9e}" for n in numbers for axis in (1, 2)),
        *("*NODE PRINT, NSET=ALL", "RF", "*END STEP", ""),
    ]
    return "\n".join(deck)


@needs_calculix
@pytest.mark.parametrize("law", LAWS)
def test_calculix_prints_of_laws_what_is_recorded(law: Law, tmp_path: Path) -> None:
    path, _ = run(law_deck(law), tmp_path, 60.0)
    rows = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    reaction = np.array([row for row in rows if len(row) == 4], dtype=float)[:, 1:3].T  # node and three components
    assert np.allclose(reaction, recorded(law), rtol=0.0, atol=1e-6 * np.abs(reaction).max())


def test_a_law_that_calculix_does_not_have_is_refused(tmp_path: Path) -> None:
    hencky = finite(scene("device2"), Law.HENCKY)
    section = mesh_section(scene("device2").coarsened(4.0), nominal_edges(hencky.device.actuators))
    with pytest.raises(CalculixError, match="no law in logarithmic strain"):
        calculix_outcome(hencky, section, hencky.device.conditions[0], SETTINGS, tmp_path, 1.0)


@pytest.mark.parametrize(
    ("contact", "friction", "said"),
    [
        (ContactModel.TURNING, 0.0, "for small kinematics"),
        (ContactModel.PENALTIES, 0.6, "frictionless pre-indentation"),
    ],
)
def test_contact_that_is_not_for_large_strains_is_refused(contact: ContactModel, friction: float, said: str) -> None:
    hencky = finite(scene("device2"), Law.HENCKY)
    section = mesh_section(scene("device2").coarsened(4.0), nominal_edges(hencky.device.actuators))
    settings = replace(SETTINGS, friction_indenting=friction, friction_acting=friction)
    with pytest.raises(ContactError, match=said):
        deformed_outcome(hencky, section, None, hencky.device.conditions[0], settings, contact)


def test_a_run_that_does_not_finish_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Though it ends with 0."""
    fake = tmp_path / PROGRAM
    fake.write_text("#!/bin/sh\necho '*ERROR: no convergence'\n", encoding="utf-8")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    with pytest.raises(CalculixError, match="no convergence"):
        run("", tmp_path / "job", 60.0)


def test_differences_of_scores_are_relative() -> None:
    """Of outcomes that are one in all but a score."""
    arc = np.linspace(0.0, 1.0, 5)
    one = Outcome(arc, np.ones((2, 5)) + arc * [[1.0], [2.0]], np.ones((2, 3, 2)), dict.fromkeys(Readout, 2.0))
    other = replace(one, score={Readout.STRAIN: 2.0, Readout.CHANGE_OF_STRAIN: 1.8})
    found = differences(other, one)
    assert found.pop("score_change_of_strain") == pytest.approx(0.1)
    assert set(found.values()) == {0.0}


@pytest.mark.parametrize("changed", ["strain", "force"])
@pytest.mark.parametrize(("time", "when"), [(0, "indented"), (1, "actuated")])
def test_differences_are_those_of_their_own_time(time: int, when: str, changed: str) -> None:
    """Strain or forces are a tenth larger after pre-indentation, or after the stimulus."""
    arc = np.linspace(0.0, 1.0, 5)
    one = Outcome(arc, np.array([arc + 1.0, 2.0 * arc + 1.0]), np.ones((2, 3, 2)), dict.fromkeys(Readout, 2.0))
    larger = getattr(one, changed).copy()
    larger[time] *= 1.1
    found = differences(replace(one, **{changed: larger}), one)
    forces = {"indented": "pressing_indented", "actuated": "force_actuated"}
    for key in ("indented", "actuated"):
        expected = 0.1 if key == when else 0.0
        assert found[f"strain_{key}"] == pytest.approx(expected if changed == "strain" else 0.0)
        assert found[forces[key]] == pytest.approx(expected if changed == "force" else 0.0)


@pytest.mark.parametrize(("friction_from", "indenting"), [(FrictionFrom.STIMULUS, 0.0), (FrictionFrom.TOUCH, 0.6)])
def test_friction_acts_from_when_on_a_case_says(friction_from: FrictionFrom, indenting: float) -> None:
    base = scene("device2")
    base = base.with_model(contact=replace(base.model.contact, friction=0.6))
    case = Case(Kinematics.SMALL, 1.0, 8, 1.0, 1.0, friction_from=friction_from)
    _, settings = deck_inputs(base, case)
    assert (settings.friction_indenting, settings.friction_acting) == (indenting, 0.6)
