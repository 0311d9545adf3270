"""Score the filtered read-outs of one device, condition and interface; its note says what to beware of."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import run
from fingerpad.prediction.caveats import note_of, score_caveats
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.roughness import score_rows
from fingerpad.readouts.strain import Resampling
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import load, write_rows


def main(
    config: Path,
    device: Path,
    solution: Path,
    filtered: Path,
    resampling: Path,
    kinematics: Kinematics,
    condition: str,
    interface: Interface,
    score: Path,
) -> None:
    """Read solution and filtered read-outs, integrate these, write one row per read-out."""
    scene = load_scene(config, device, kinematics)
    tried, solved, read = scene.device.condition(condition), load(solution, Solution), load(filtered, FilteredReadouts)
    caveats = score_caveats(scene, tried, interface, solved, load(resampling, Resampling))
    write_rows(score, score_rows(scene, tried, interface, read, note_of(caveats)))


if __name__ == "__main__":
    run(main, snakemake)
