"""Runs that are killed, run out of disk, or meet another run in the same folder: no byte differs, nothing is lost."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from conftest import LONGEST_RUN, Project, coarse_run, into, results

pytestmark = pytest.mark.workflow

KILLS = 10
MOST_NEW = 3  # results after which a run is killed at the latest
LOOK = 0.01  # s between looks at how many results there are
DISK = "8m"  # of a small disk: room for results of a few jobs


def started(project: Project, coarse_scenes: Path, there: Path, *options: str) -> subprocess.Popen[bytes]:
    """A run in a process group of its own."""
    return subprocess.Popen(
        project.command(*coarse_run(coarse_scenes, there), *options),
        cwd=project.folder,
        env=project.environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def killed(process: subprocess.Popen[bytes]) -> None:
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def unlock(project: Project, coarse_scenes: Path, there: Path) -> None:
    run = project.snakemake("--unlock", *into(there, coarse_scenes))
    assert run.status == 0, run.text


def test_kills_leave_no_trace(
    project: Project, coarse_scenes: Path, undisturbed: dict[str, str], tmp_path: Path
) -> None:
    """Kill a run once it has made a random number of results, as a power cut would, and start it again each time.
    Whenever one gets to its end, its results are those of an undisturbed run, to the last byte, and the next begins
    from nothing. Most kills leave some results, and not all."""

    def there() -> int:
        return sum((tmp_path / name).exists() for name in undisturbed)

    numbers, left = random.Random(0), list[int]()
    for _ in range(KILLS):
        # the first lock left behind is taken off as users do, the others are passed over, which saves a start each
        process = started(project, coarse_scenes, tmp_path, *(["--nolock"] if left else []))
        enough, pause = there() + numbers.randint(1, MOST_NEW), numbers.uniform(0.0, 10.0 * LOOK)
        while process.poll() is None and there() < enough:
            time.sleep(LOOK)
        time.sleep(pause)  # into the next job
        if process.poll() is None:
            killed(process)
            if not left:
                unlock(project, coarse_scenes, tmp_path)
            left.append(there())
            continue
        assert process.returncode == 0
        assert results(tmp_path) == undisturbed
        shutil.rmtree(tmp_path / "results")
    run = project.snakemake(*coarse_run(coarse_scenes, tmp_path), "--nolock")
    assert run.status == 0, run.text
    assert results(tmp_path) == undisturbed
    partly = [number for number in left if 0 < number < len(undisturbed)]
    assert len(partly) > KILLS / 2, left


def test_a_second_run_in_one_folder_is_refused(
    project: Project, coarse_scenes: Path, undisturbed: dict[str, str], tmp_path: Path
) -> None:
    """It says that the folder is locked and how to unlock it; the first run ends as if it had been alone."""
    process = started(project, coarse_scenes, tmp_path)
    try:
        end = time.monotonic() + LONGEST_RUN
        # of its two lists, the one of what it writes is what a second run would meet
        while not any(lock.stat().st_size for lock in tmp_path.glob(".snakemake/locks/*.output.lock")):
            assert time.monotonic() < end, "the first run never locked its folder"
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGSTOP)  # so that it is not at its end before the second has begun
        second = project.snakemake(*coarse_run(coarse_scenes, tmp_path))
        os.killpg(process.pid, signal.SIGCONT)
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
    project: Project, coarse_scenes: Path, undisturbed: dict[str, str], small_disk: Path
) -> None:
    """The error names the disk; what was whole before stays whole, no half a file remains, and with room again the
    run goes on to the same bytes."""
    first = ("results/small/device2/mesh.npz", *into(small_disk, coarse_scenes))
    run = project.snakemake(*first)
    assert run.status == 0, run.text
    before = results(small_disk)
    filler = small_disk / "filler"
    room = shutil.disk_usage(small_disk).free
    filler.write_bytes(bytes(room - 2**16))  # what Snakemake itself notes down still fits
    run = project.snakemake(*coarse_run(coarse_scenes, small_disk))
    assert run.status != 0
    assert "No space left on device" in run.text
    left = results(small_disk)
    assert before.items() <= left.items() <= undisturbed.items()
    filler.unlink()
    run = project.snakemake(*coarse_run(coarse_scenes, small_disk))
    assert run.status == 0, run.text
    assert results(small_disk) == undisturbed
