"""Write a page of docs/ that says what was computed or measured."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.jobs import run
from fingerpad.pages.accuracy import accuracy_values
from fingerpad.pages.claims import claims_values
from fingerpad.pages.filling import filled
from fingerpad.pages.frequency import frequency_values
from fingerpad.pages.robustness import robustness_values
from fingerpad.pages.run_time import run_time_values
from fingerpad.pages.scorings import scorings_values
from fingerpad.pages.skipping import skipping_values
from fingerpad.store import read_table

VALUES = {
    "accuracy": accuracy_values,
    "claims": claims_values,
    "frequency": frequency_values,
    "robustness": robustness_values,
    "run-time": run_time_values,
    "scorings": scorings_values,
    "skipping": skipping_values,
}


def main(page: str, template: Path, names: list[str], tables: list[Path], written: Path) -> None:
    """Read template and tables, some of which may be empty, write the page."""
    read = {name: read_table(path) for name, path in zip(names, tables, strict=True)}
    values = VALUES[page](read)
    write_text(written, filled(template.read_text(encoding="utf-8"), values))


if __name__ == "__main__":
    run(main, snakemake)
