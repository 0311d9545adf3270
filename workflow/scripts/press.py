"""Press one device onto the finger, with finite kinematics, and condense the finger about that state."""

from pathlib import Path

from fingerpad.finite.pressing import press
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import save
from fingerpad.tissue.compliance import load_body
from fingerpad.tissue.mesh import load_section


def main(config: Path, device: Path, mesh: Path, body: Path | None, interface: Interface, pressed: Path) -> None:
    """Read scene and mesh, raise the actuators, write the state that they reach."""
    scene = load_scene(config, device, Kinematics.FINITE)
    save(pressed, press(scene, load_section(mesh), load_body(body), interface))


if __name__ == "__main__":
    run(main, snakemake)
