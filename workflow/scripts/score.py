"""Score the filtered read-outs of one device, condition and interface."""

from pathlib import Path

from fingerpad.contact_law import Interface
from fingerpad.roughness import score_rows
from fingerpad.scenefile import load_scene
from fingerpad.store import load, write_rows
from fingerpad.strain import FilteredReadouts
from fingerpad.tissue_law import Kinematics


def main(
    config: Path, device: Path, filtered: Path, kinematics: str, condition: str, interface: str, score: Path
) -> None:
    """Read the filtered read-outs, integrate them, write one row a read-out."""
    scene = load_scene(config, device, Kinematics(kinematics))
    rows = score_rows(scene, scene.device.condition(condition), Interface(interface), load(filtered, FilteredReadouts))
    write_rows(score, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.filtered),
        job.wildcards.kinematics,
        job.wildcards.condition,
        job.wildcards.interface,
        Path(job.output.score),
    )
