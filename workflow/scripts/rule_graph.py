"""Write which rule of `snakemake report` feeds which, as Snakemake plans a run from nothing."""

import subprocess
import sys
import tempfile
from pathlib import Path

from fingerpad.digraph import read_dot
from fingerpad.jobs import run
from fingerpad.store import write_rows


def main(snakefile: Path, config: Path, graph: Path) -> None:
    """Ask for the graph of rules in an empty folder, where no other run can be in the way; write its edges."""
    command = [sys.executable, "-m", "snakemake", "report", "--rulegraph", "dot", "--snakefile", str(snakefile)]
    with tempfile.TemporaryDirectory() as folder:
        given = ["--directory", folder, "--cores", "1", "--config", f"scenes={config.parent.resolve()}"]
        dot = subprocess.run([*command, *given], check=True, stdout=subprocess.PIPE, text=True).stdout
    write_rows(graph, [{"rule": start, "feeds": stop} for start, stop in read_dot(dot)])


if __name__ == "__main__":
    run(main, snakemake)
