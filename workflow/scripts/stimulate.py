"""Solve the stimulus of one device, condition and interface, with finite kinematics."""

from pathlib import Path

from fingerpad.finite.deformed_solution import pressed_finger, stimulate_deformed
from fingerpad.finite.pressing import Pressed
from fingerpad.jobs import logged
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
    interface: str,
    solution: Path,
) -> None:
    """Read scene, mesh and pressed finger, follow the condition's stimulus, write the certified solution."""
    scene = load_scene(config, device, Kinematics.FINITE)
    finger = pressed_finger(scene, load_section(mesh), load_body(body), load(pressed, Pressed), Interface(interface))
    save(solution, stimulate_deformed(scene, finger, scene.device.condition(condition)))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            Path(job.input.device),
            Path(job.input.mesh),
            Path(job.input.body) if job.input.body else None,
            Path(job.input.pressed),
            job.wildcards.condition,
            job.wildcards.interface,
            Path(job.output.solution),
        )
