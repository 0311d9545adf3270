"""Score the filtered read-outs of one device, condition and interface; its note says what to beware of."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import run
from fingerpad.prediction.caveats import noted_rows
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, write_rows


def main(
    config: Path,
    device: Path,
    solution: Path,
    filtered: Path,
    kinematics: Kinematics,
    condition: str,
    interface: Interface,
    score: Path,
) -> None:
    """Read solution and filtered read-outs, integrate these, write one row per read-out."""
    scene = load_scene(config, device, kinematics)
    tried, solved, read = scene.device.condition(condition), load(solution, Solution), load(filtered, FilteredReadouts)
    write_rows(score, noted_rows(scene, tried, interface, solved, read))


if __name__ == "__main__":
    run(main, snakemake)
