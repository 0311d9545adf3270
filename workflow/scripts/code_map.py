"""Write the map of the code."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.jobs import run
from fingerpad.pages.codemap import page


def main(package: list[Path], rules: list[Path], scripts: list[Path], written: Path) -> None:
    """Read modules, rules and scripts, write the page."""
    folder = package[0].parent
    modules = {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in folder.rglob("*.py")}
    texts = ({path.stem: path.read_text(encoding="utf-8") for path in paths} for paths in (rules, scripts))
    write_text(written, page(modules, *texts))


if __name__ == "__main__":
    run(main, snakemake)
