"""Write the map of the code."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.jobs import logged
from fingerpad.pages.codemap import page


def main(package: Path, rules: list[Path], scripts: list[Path], written: Path) -> None:
    """Read modules, rules and scripts, write the page."""
    modules = {path.relative_to(package).as_posix(): path.read_text(encoding="utf-8") for path in package.rglob("*.py")}
    texts = ({path.stem: path.read_text(encoding="utf-8") for path in paths} for paths in (rules, scripts))
    write_text(written, page(modules, *texts))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.package[0]).parent,
            [Path(path) for path in job.input.rules],
            [Path(path) for path in job.input.scripts],
            Path(job.output.page),
        )
