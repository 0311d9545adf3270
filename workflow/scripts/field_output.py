"""Write the full fields of one device, condition and interface as VTU files and their path in time as a PVD file."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.fields.states import deformed_states, linear_states
from fingerpad.fields.vtu import field_meshes, write_path
from fingerpad.finite.deformed_solution import pressed_finger
from fingerpad.finite.pressing import Pressed
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load
from fingerpad.tissue.compliance import load_body
from fingerpad.tissue.mesh import load_section


def main(
    kinematics: Kinematics,
    config: Path,
    device: Path,
    mesh: Path,
    body: Path | None,
    pressed: Path | None,
    solution: Path,
    condition: str,
    interface: Interface,
    vtu: Path,
    pvd: Path,
    states: Path,
) -> None:
    """Read mesh and solution, recover the fields of all states, write the last and, in a folder, those before.

    pressed: with finite kinematics the pressed finger, from where the stimulus is solved, as forces are not enough.
    """
    scene, section = load_scene(config, device, kinematics), load_section(mesh)
    moved = scene.device.condition(condition)
    if pressed:
        finger = pressed_finger(scene, section, load_body(body), load(pressed, Pressed), interface)
        found = deformed_states(scene, finger, moved)
    else:
        found = linear_states(scene, section, load(solution, Solution))
    write_path(pvd, states, vtu, moved.times, field_meshes(section, scene, found))


if __name__ == "__main__":
    run(main, snakemake)
