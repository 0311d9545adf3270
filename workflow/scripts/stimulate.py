"""Solve the stimulus of one device, condition and interface, with finite kinematics."""

from pathlib import Path

from fingerpad.finite.deformed_solution import pressed_finger, stimulate_deformed
from fingerpad.finite.pressing import Pressed
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, save
from fingerpad.tissue.compliance import load_body
from fingerpad.tissue.mesh import load_section


def main(
    config: Path,
    device: Path,
    mesh: Path,
    body: Path | None,
    pressed: Path,
    condition: str,
    interface: Interface,
    solution: Path,
) -> None:
    """Read scene, mesh and pressed finger, follow the condition's stimulus, write the certified solution."""
    scene = load_scene(config, device, Kinematics.FINITE)
    finger = pressed_finger(scene, load_section(mesh), load_body(body), load(pressed, Pressed), interface)
    save(solution, stimulate_deformed(scene, finger, scene.device.condition(condition)))


if __name__ == "__main__":
    run(main, snakemake)
