"""Score the filtered read-outs of one device, condition and interface; its note says what to beware of."""

from pathlib import Path

from fingerpad.contact.solution import Solution
from fingerpad.jobs import logged
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
    kinematics: str,
    condition: str,
    interface: str,
    score: Path,
) -> None:
    """Read solution and filtered read-outs, integrate these, write one row per read-out."""
    scene = load_scene(config, device, Kinematics(kinematics))
    tried, solved, read = scene.device.condition(condition), load(solution, Solution), load(filtered, FilteredReadouts)
    write_rows(score, noted_rows(scene, tried, Interface(interface), solved, read))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            Path(job.input.device),
            Path(job.input.solution),
            Path(job.input.filtered),
            job.wildcards.kinematics,
            job.wildcards.condition,
            job.wildcards.interface,
            Path(job.output.score),
        )
