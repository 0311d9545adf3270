"""Draw the stimuli of all devices, actuator by actuator."""

from pathlib import Path

from fingerpad.figures.stimuli import stimuli_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene


def main(config: Path, devices: list[Path], png: Path) -> None:
    """Read the scene files, draw, write PNG and PDF."""
    save(stimuli_figure([load_scene(config, path).device for path in devices]), png)


if __name__ == "__main__":
    run(main, snakemake)
