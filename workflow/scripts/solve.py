"""Solve one device, condition and interface."""

from pathlib import Path

from fingerpad.contact.linear_solution import solve_condition
from fingerpad.jobs import run
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, save
from fingerpad.tissue.compliance import CondensedSection, load_body


def main(
    config: Path, device: Path, condensed: Path, body: Path | None, condition: str, interface: Interface, solution: Path
) -> None:
    """Read scene and compliance, follow the condition's path, write the certified solution."""
    scene = load_scene(config, device)
    save(
        solution,
        solve_condition(
            scene,
            load(condensed, CondensedSection),
            load_body(body),
            scene.device.condition(condition),
            interface,
        ),
    )


if __name__ == "__main__":
    run(main, snakemake)
