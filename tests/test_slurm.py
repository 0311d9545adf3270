"""The same run through SLURM, on a real cluster of one node: the same bytes."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest

from conftest import ROOT, Project, into, results

pytestmark = pytest.mark.workflow

SCRIPT = ROOT / "tests" / "slurm" / "cluster.sh"
SCORE = "results/small/device2/alternate_180/shear/score.csv"
SUBMISSIONS = 3  # mesh; condense; solve, filter and score together
PROGRAMS = ("slurmctld", "slurmd", "sbatch", "munged")  # of Debian's packages slurm-wlm and munge


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)} (Debian: slurm-wlm, munge)")
    if find_spec("snakemake_executor_plugin_slurm") is None:
        pytest.skip("not installed: snakemake-executor-plugin-slurm")
    if os.geteuid() != 0:
        pytest.skip("only root may start a cluster")
    folder = tmp_path_factory.mktemp("cluster")
    begun = subprocess.run([SCRIPT, "start", folder], capture_output=True, text=True, check=False)
    if "SLURM of its own" in begun.stderr:
        pytest.skip(begun.stderr.strip())
    assert begun.returncode == 0, begun.stderr
    yield
    subprocess.run([SCRIPT, "stop", folder], check=True)


@pytest.mark.usefixtures("cluster")
def test_a_run_through_slurm_has_the_same_bytes(
    project: Project, coarse_scenes: Path, undisturbed: dict[str, str], tmp_path: Path
) -> None:
    profile = project.folder / "profiles" / "slurm"
    quick = ("--slurm-init-seconds-before-status-checks", "2", "--seconds-between-status-checks", "2")
    where = into(tmp_path, coarse_scenes)
    run = project.snakemake(SCORE, *where, "--profile", profile, *quick)
    assert run.status == 0, run.text
    assert run.text.count("has been submitted with SLURM jobid") == SUBMISSIONS
    found = results(tmp_path)
    assert SCORE in found
    assert found.items() <= undisturbed.items()
