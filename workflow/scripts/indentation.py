"""Force against indentation of all devices, interfaces and kinematics, as one table."""

from pathlib import Path

from fingerpad.contact.force_curve import curve_rows, small_strain_curve
from fingerpad.contact.problem import contact_problem
from fingerpad.finite.pressing import Pressed
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, write_rows
from fingerpad.tissue.compliance import CondensedSection, load_body


def main(
    config: Path,
    devices: list[Path],
    condensed: list[Path],
    bodies: list[Path],
    pressed: list[Path],
    cases: list[tuple[str, Interface]],
    table: Path,
) -> None:
    """Follow the small-strain curves, read the others, write all. bodies: of the devices that have one. cases: device
    and interface of every `pressed`.
    """
    rows = []
    curves = dict(zip(cases, pressed, strict=True))
    actuators = {path.stem: path for path in bodies}
    for path, section in zip(devices, condensed, strict=True):
        scene = load_scene(config, path)
        name = scene.device.name
        body = load_body(actuators.get(name))
        for interface in scene.device.interfaces():
            problem = contact_problem(scene, load(section, CondensedSection), body, interface)
            rows += curve_rows(name, interface, Kinematics.SMALL, small_strain_curve(scene, problem))
            if (name, interface) in curves:
                rows += curve_rows(name, interface, Kinematics.FINITE, load(curves[name, interface], Pressed).curve)
    write_rows(table, rows)


if __name__ == "__main__":
    run(main, snakemake)
