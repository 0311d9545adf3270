"""Turn every skip off in turn, and write what that costs and how far scores move."""

from pathlib import Path

from fingerpad.benchmark.skipping import always_rows, skip_rows
from fingerpad.scenefile import load_scene
from fingerpad.store import read_rows, write_rows


def main(config: Path, devices: list[Path], scores: Path, repeats: int, switches: Path, always: Path) -> None:
    """Read scenes and scores, time every device with and without every skip, write two tables."""
    stated = read_rows(scores)
    scenes = [load_scene(config, path) for path in devices]
    write_rows(switches, [row for scene in scenes for row in skip_rows(scene, stated, repeats)])
    write_rows(always, [row for scene in scenes for row in always_rows(scene, repeats)])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        [Path(path) for path in job.input.devices],
        Path(job.input.scores),
        job.params.repeats,
        Path(job.output.switches),
        Path(job.output.always),
    )
