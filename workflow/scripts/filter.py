"""Filter the receptor read-outs of one device, condition and interface."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import run
from fingerpad.readouts.gabor import filtered_readouts
from fingerpad.readouts.strain import Resampling
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import load, save


def main(config: Path, device: Path, resampling: Path, solution: Path, filtered: Path) -> None:
    """Read the receptors' strains, filter them, write both on the uniform grid."""
    gabor = load_scene(config, device).model.gabor
    save(filtered, filtered_readouts(load(resampling, Resampling), load(solution, Solution).reading.readouts, gabor))


if __name__ == "__main__":
    run(main, snakemake)
