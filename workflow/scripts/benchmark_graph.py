"""Time `snakemake all` from nothing, and the same graph of jobs with empty scripts, one after the other."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from itertools import product
from pathlib import Path

import yaml

from fingerpad.jobs import run
from fingerpad.scene.variation import with_value
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.store import write_rows

EMPTY_SCRIPT = '''"""An empty job: it makes its outputs and does nothing."""

from pathlib import Path

for path in snakemake.output:
    Path(path).touch()
'''


def seconds_of_all(project: Path, cores: int) -> float:
    """Wall time [s] of `snakemake all` in a folder."""
    command = [sys.executable, "-m", "snakemake", "all", "--cores", str(cores), "--quiet", "all"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    start = time.perf_counter()
    subprocess.run(command, cwd=project, check=True, env=environment, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def copied(base: Path, files: list[Path], folder: str, kinematics: str, empty: bool) -> Path:
    """A copy of the project's files, which lie in base, in a folder, for those kinematics ("small" or "both"), with its
    scripts or empty ones.
    """
    project = Path(folder) / "project"
    for file in files:
        copy = project / file.relative_to(base)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, copy)
    config = project / "config" / "config.yaml"
    model = with_value(read_yaml(config), "tissue.kinematics", kinematics, "varied")
    config.write_text(yaml.safe_dump(model, sort_keys=False), encoding="utf-8")
    if empty:
        for script in (project / "workflow" / "scripts").glob("*.py"):
            script.write_text(EMPTY_SCRIPT, encoding="utf-8")
    return project


def main(snakefile: Path, files: list[Path], threads: int, kinematics: list[str], repeats: int, graph: Path) -> None:
    """Copy the project, empty the scripts of every second copy, time all in turns, the real ones twice; write all."""
    rows = []
    for repeat, each in product(range(1, repeats + 1), kinematics):
        found = {}
        for kind in ("empty", "real"):
            with tempfile.TemporaryDirectory() as folder:
                project = copied(snakefile.parent, files, folder, each, empty=kind == "empty")
                found[kind] = seconds_of_all(project, threads)
                if kind == "real":
                    found["again"] = seconds_of_all(project, threads)
        seconds = {f"{kind}_s": round(value, 1) for kind, value in found.items()}
        ratio = round(found["real"] / found["empty"], 2)
        rows.append({"repeat": repeat, "cores": threads, "kinematics": each, **seconds, "ratio": ratio})
    write_rows(graph, rows)


if __name__ == "__main__":
    run(main, snakemake)
