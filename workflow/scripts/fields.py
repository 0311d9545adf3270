"""Recover the full fields of every stimulus of a device, with friction."""

from pathlib import Path

import numpy as np

from fingerpad.contact.solution import Solution
from fingerpad.fields.recovery import recover_displacement
from fingerpad.fields.states import deformed_states, states_fields
from fingerpad.finite.deformed_solution import pressed_finger
from fingerpad.finite.pressing import Pressed
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, save
from fingerpad.tissue.compliance import load_body
from fingerpad.tissue.mesh import load_section


def main(
    kinematics: Kinematics,
    config: Path,
    device: Path,
    mesh: Path,
    body: Path | None,
    pressed: Path | None,
    solutions: list[Path],
    fields: Path,
) -> None:
    """Recover the fields of every solution as it was pressed and when it is read, write them in the same order.

    pressed: with finite kinematics the pressed finger, from where every stimulus is solved, as forces are not enough.
    """
    scene, section = load_scene(config, device, kinematics), load_section(mesh)
    solved = [load(path, Solution) for path in solutions]
    if pressed:
        finger = pressed_finger(scene, section, load_body(body), load(pressed, Pressed), Interface.SHEAR)
        states = [deformed_states(scene, finger, each).displacement for each in scene.device.distinct_conditions]
        read = (each[1 + one.reading.time] for each, one in zip(states, solved, strict=True))
        displacement = np.array([states[0][0], *read])
    else:
        forces = np.array([solved[0].force[0], *(each.force[1 + each.reading.time] for each in solved)])
        displacement = recover_displacement(section, scene, forces)
    save(fields, states_fields(scene, section, displacement))


if __name__ == "__main__":
    run(main, snakemake)
