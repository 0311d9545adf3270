"""List every value of the scene files by where it comes from, and what is assumed in code."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.jobs import run
from fingerpad.pages.assumptions import page
from fingerpad.scene.yamlfile import read_yaml


def main(files: list[Path], package: list[Path], listed: Path) -> None:
    """Read the scene files and the code, write the page."""
    named = {f"{path.parent.name}/{path.name}": read_yaml(path) for path in files}
    folder = package[0].parent
    code = {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.py"))
    }
    write_text(listed, page(named, code))


if __name__ == "__main__":
    run(main, snakemake)
