"""Runs that are killed, run out of disk, or meet another run in the same folder: no byte differs, nothing is lost."""

from __future__ import annotations

import os
import random
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from conftest import LONGEST_RUN, Project

pytestmark = pytest.mark.workflow

KILLS = 20
SHORTEST, LONGEST = 1.5, 5.0  # s after which a run is killed: from reading the rules to drawing the last figures
COARSER = {"edge_size": 4.0, "face_size": 4.0, "receptor_size": 4.0}  # times the shipped sizes: a run of seconds
DISK = "8m"  # of a small disk: room for results of a few jobs
TARGETS = (
    "results/correlations.csv",
    "results/figures/figure_4_receptors.png",
    "results/figures/figure_4_receptors.pdf",
)
NOT_RESULTS = ("results/logs/", "results/benchmarks/")  # they say when and how long


@pytest.fixture(scope="module")
def scenes(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Device 2 alone, on a coarse mesh."""
    folder = tmp_path_factory.mktemp("scenes")
    (folder / "devices").mkdir()
    shutil.copy2(project.folder / "config/devices/device2.yaml", folder / "devices")
    text = (project.folder / "config/config.yaml").read_text(encoding="utf-8")
    for key, factor in COARSER.items():
        text = re.sub(
            rf"({key}: {{value: )([\d.]+)", lambda found, factor=factor: f"{found[1]}{factor * float(found[2])}", text
        )
    (folder / "config.yaml").write_text(text, encoding="utf-8")
    return folder


def arguments(scenes: Path, there: Path) -> tuple[str | Path, ...]:
    return (*TARGETS, "--directory", there, "--config", f"scenes={scenes}")


def results(folder: Path) -> dict[str, str]:
    """Checksums of all results in a folder but for logs and times."""
    found = Project(folder).files("results")
    return {name: checksum for name, (_, checksum) in found.items() if not name.startswith(NOT_RESULTS)}


@pytest.fixture(scope="module")
def undisturbed(project: Project, scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("undisturbed")
    run = project.snakemake(*arguments(scenes, folder))
    assert run.status == 0, run.text
    return results(folder)


def started(project: Project, scenes: Path, there: Path) -> subprocess.Popen[bytes]:
    """A run in a process group of its own."""
    return subprocess.Popen(
        project.command(*arguments(scenes, there)),
        cwd=project.folder,
        env=project.environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def killed(process: subprocess.Popen[bytes]) -> None:
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def unlock(project: Project, scenes: Path, there: Path) -> None:
    run = project.snakemake("--unlock", "--directory", there, "--config", f"scenes={scenes}")
    assert run.status == 0, run.text


def test_twenty_kills_leave_no_trace(
    project: Project, scenes: Path, undisturbed: dict[str, str], tmp_path: Path
) -> None:
    """Kill a run at random moments, as a power cut would, and start it again each time. Whenever one gets to its end,
    its results are those of an undisturbed run, to the last byte, and the next begins from nothing."""
    moments = random.Random(0)
    unfinished = 0
    for _ in range(KILLS):
        process = started(project, scenes, tmp_path)
        try:
            process.wait(timeout=moments.uniform(SHORTEST, LONGEST))
        except subprocess.TimeoutExpired:
            unfinished += 1
            killed(process)
            unlock(project, scenes, tmp_path)
            continue
        assert process.returncode == 0
        assert results(tmp_path) == undisturbed
        shutil.rmtree(tmp_path / "results")
    run = project.snakemake(*arguments(scenes, tmp_path))
    assert run.status == 0, run.text
    assert results(tmp_path) == undisturbed
    assert unfinished > KILLS / 2


def test_a_second_run_in_one_folder_is_refused(
    project: Project, scenes: Path, undisturbed: dict[str, str], tmp_path: Path
) -> None:
    """It says that the folder is locked and how to unlock it; the first run ends as if it had been alone."""
    process = started(project, scenes, tmp_path)
    try:
        end = time.monotonic() + LONGEST_RUN
        while not list(tmp_path.glob(".snakemake/locks/*")):
            assert time.monotonic() < end, "the first run never locked its folder"
            time.sleep(0.02)
        second = project.snakemake(*arguments(scenes, tmp_path))
        assert second.status != 0
        assert "cannot be locked" in second.text
        assert "--unlock" in second.text
        assert not second.jobs
        assert process.wait(timeout=LONGEST_RUN) == 0
    finally:
        if process.poll() is None:
            killed(process)
    assert results(tmp_path) == undisturbed


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of a few megabytes."""
    folder = tmp_path / "disk"
    folder.mkdir()
    if shutil.which("mount") is None:
        pytest.skip("no `mount` here")
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={DISK}", "none", folder], capture_output=True, check=False
    )
    if mounted.returncode != 0:
        pytest.skip(f"mounting is not allowed here: {mounted.stderr.decode().strip()}")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_a_full_disk_is_said_and_nothing_is_lost(
    project: Project, scenes: Path, undisturbed: dict[str, str], small_disk: Path
) -> None:
    """The error names the disk; what was whole before stays whole, no half a file remains, and with room again the
    run goes on to the same bytes."""
    first = ("results/device2/mesh.npz", *arguments(scenes, small_disk)[len(TARGETS) :])
    run = project.snakemake(*first)
    assert run.status == 0, run.text
    before = results(small_disk)
    filler = small_disk / "filler"
    room = shutil.disk_usage(small_disk).free
    filler.write_bytes(bytes(room - 2**16))  # what Snakemake itself notes down still fits
    run = project.snakemake(*arguments(scenes, small_disk))
    assert run.status != 0
    assert "No space left on device" in run.text
    left = results(small_disk)
    assert before.items() <= left.items() <= undisturbed.items()
    filler.unlink()
    run = project.snakemake(*arguments(scenes, small_disk))
    assert run.status == 0, run.text
    assert results(small_disk) == undisturbed
