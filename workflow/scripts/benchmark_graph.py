"""Time `snakemake all` from nothing, and the same graph of jobs with empty scripts, one after the other."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from fingerpad.store import write_rows

COPIED = ("Snakefile", "workflow", "src", "config", "data", "notebooks", "profiles", "environment.yml")
EMPTY_SCRIPT = '''"""An empty job: it makes its outputs and does nothing."""

from pathlib import Path

for path in snakemake.output:  # noqa: F821
    Path(path).touch()
'''


def seconds_of_all(project: Path, cores: int) -> float:
    """Wall time [s] of `snakemake all` in a folder."""
    command = [sys.executable, "-m", "snakemake", "all", "--cores", str(cores), "--quiet", "all"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    start = time.perf_counter()
    subprocess.run(command, cwd=project, check=True, env=environment, capture_output=True)
    return time.perf_counter() - start


def main(base: Path, cores: int, repeats: int, table: Path) -> None:
    """Copy the project twice, empty the scripts of one copy, time both in turns, and the real one again; write all."""
    rows = []
    for repeat in range(1, repeats + 1):
        found = {}
        for kind in ("empty scripts", "real"):
            with tempfile.TemporaryDirectory() as folder:
                project = Path(folder) / "project"
                project.mkdir()
                for name in COPIED:
                    copy = shutil.copytree if (base / name).is_dir() else shutil.copy2
                    copy(base / name, project / name)
                if kind == "empty scripts":
                    for script in (project / "workflow" / "scripts").glob("*.py"):
                        script.write_text(EMPTY_SCRIPT, encoding="utf-8")
                found[kind] = seconds_of_all(project, cores)
                found["again"] = seconds_of_all(project, cores)
        rows.append(
            {
                "repeat": repeat,
                "cores": cores,
                "empty_s": round(found["empty scripts"], 1),
                "real_s": round(found["real"], 1),
                "again_s": round(found["again"], 1),
                "ratio": round(found["real"] / found["empty scripts"], 2),
            }
        )
    write_rows(table, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.snakefile).parent, job.threads, job.params.repeats, Path(job.output.graph))
