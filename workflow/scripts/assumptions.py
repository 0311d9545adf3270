"""List every value of the scene files by where it comes from, and what is assumed in code."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.scenefile import read_yaml
from fingerpad.sources import page


def main(files: list[Path], modules: list[Path], listed: Path) -> None:
    """Read the scene files and the code, write the page."""
    named = {f"{path.parent.name}/{path.name}": read_yaml(path) for path in files}
    write_text(listed, page(named, {path.stem: path.read_text(encoding="utf-8") for path in modules}))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        [Path(path) for path in job.input.files],
        [Path(path) for path in job.input.modules],
        Path(job.output.listed),
    )
