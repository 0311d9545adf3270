"""Draw the stimuli of all devices, actuator by actuator."""

from pathlib import Path

from fingerpad.figures.stimuli import stimuli_figure
from fingerpad.figures.style import save
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene


def main(config: Path, devices: list[Path], stem: Path) -> None:
    """Read the scene files, draw, write PNG and PDF."""
    save(stimuli_figure([load_scene(config, path).device for path in devices]), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(Path(job.input.config), [Path(path) for path in job.input.devices], Path(job.output.png).with_suffix(""))
