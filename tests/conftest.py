"""A copy of the project in a temporary folder, and one complete run of its workflow there, for the workflow tests."""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CORES = 2
TABLE_AND_FIGURE = (
    "results/correlations.csv",
    "results/figures/figure_4_receptors.png",
    "results/figures/figure_4_receptors.pdf",
)
SMALL_ONLY = "short"  # a device for which finite kinematics are left out
COARSER = {
    "edge_size": 8.0,
    "face_size": 2.0,
    "receptor_size": 6.0,
    "nail_size": 8.0,
}  # times the shipped sizes: a run of seconds
NOT_RESULTS = ("results/logs/", "results/benchmarks/")  # they say when and how long
LONGEST = "test_adding_a_device.py"
LONGEST_RUN = 1800.0  # s; a complete run takes minutes, and one that takes longer hangs
NOT_SOURCE = ("results", ".snakemake", ".venv", ".git", "__pycache__", "*.egg-info", ".ipynb_checkpoints", ".*_cache")

sys.path.insert(0, str(ROOT / "workflow"))  # `support` is what the Snakefile imports


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker of the tests that run Snakemake: `-m "not workflow"` leaves them out."""
    config.addinivalue_line("markers", "workflow: runs Snakemake on a copy of the project")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests that run Snakemake first: they are the longest, and no core should wait for them at the end. Of these the
    longest of all, then those without the finished project, so that one process makes it while others go on.
    """

    def place(item: pytest.Item) -> tuple[bool, bool]:
        shares = "finished" in getattr(item, "fixturenames", ())
        return item.get_closest_marker("workflow") is None, shares and item.path.name != LONGEST

    items.sort(key=place)


@dataclass(frozen=True)
class Job:
    """A job as Snakemake announces it."""

    rule: str
    inputs: frozenset[str]
    outputs: frozenset[str]
    device: str | None


@dataclass(frozen=True)
class Run:
    """What a call of Snakemake said: its exit status, its whole output and the jobs that it announced."""

    status: int
    text: str

    @property
    def jobs(self) -> frozenset[Job]:
        """Jobs that ran or, in a dry run, would have run."""
        blocks = re.findall(r"^(?:local)?rule (\w+):\n((?:    .*\n)+)", self.text, re.MULTILINE)
        return frozenset(_job(rule, dict(re.findall(r"^    (\w+): (.*)$", body, re.M))) for rule, body in blocks)

    @property
    def outputs(self) -> frozenset[str]:
        """All files that these jobs make."""
        return frozenset().union(*(job.outputs for job in self.jobs))


def _job(rule: str, said: dict[str, str]) -> Job:
    inputs, outputs = (frozenset(said.get(key, "").split(", ")) - {""} for key in ("input", "output"))
    device = re.search(r"\bdevice=(\w+)", said.get("wildcards", ""))
    return Job(rule, inputs, outputs, device[1] if device else None)


@dataclass(frozen=True)
class Project:
    """A copy of the project."""

    folder: Path

    def command(self, *arguments: str | Path) -> list[str]:
        """A call of Snakemake that announces every job."""
        given = [str(argument) for argument in arguments]
        return [sys.executable, "-m", "snakemake", *given, "--cores", str(CORES), "--quiet", "progress"]

    def environment(self) -> dict[str, str]:
        """The environment of a user who has activated the project's and set nothing else."""
        return {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "SNAKEMAKE"))}

    def snakemake(self, *arguments: str | Path) -> Run:
        """Call Snakemake in the project's folder and wait for its end."""
        done = subprocess.run(
            self.command(*arguments),
            cwd=self.folder,
            env=self.environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=LONGEST_RUN,
            check=False,
        )
        return Run(done.returncode, done.stdout)

    def files(self, folder: str = ".") -> dict[str, tuple[int, str]]:
        """Time of change and checksum of every file below a folder, but for what Python and Snakemake keep there."""
        paths = (path for path in (self.folder / folder).rglob("*") if path.is_file())
        return {
            str(path.relative_to(self.folder)): (path.stat().st_mtime_ns, hashlib.sha256(path.read_bytes()).hexdigest())
            for path in paths
            if not {"__pycache__", ".snakemake"} & set(path.parts)
        }

    def edit(self, name: str, change: Callable[[str], str]) -> None:
        """Rewrite one file. The change must change something."""
        path = self.folder / name
        before = path.read_text(encoding="utf-8")
        after = change(before)
        assert after != before, f"{name} has not changed"
        path.write_text(after, encoding="utf-8")


def with_small_kinematics(project: Project) -> Project:
    """The project with small kinematics alone, which take the least time. `finite_run` is for the others."""
    project.edit("config/config.yaml", lambda text: text.replace("{value: both", "{value: small"))
    return project


@pytest.fixture(scope="session")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The project as a fresh checkout would have it: its files, tracked or about to be, without devices of one's own
    and without results.
    """
    folder = tmp_path_factory.mktemp("project") / "fingerpad"
    try:
        command = ["git", "ls-files", "-co", "--exclude-standard", "-z"]
        listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
        tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):  # an unpacked archive, or no git
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*NOT_SOURCE))
        return with_small_kinematics(Project(folder))
    for name in filter(None, listed.split("\0")):
        is_own = name.startswith("config/devices/") and name not in tracked.split("\0")
        if (ROOT / name).is_file() and not is_own:  # nor one that is deleted, but still tracked
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return with_small_kinematics(Project(folder))


@contextmanager
def alone(lock: Path) -> Iterator[None]:
    """While it lasts, no other process of the tests is within it."""
    with lock.open("w", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


@pytest.fixture(scope="session")
def finished(project: Project, tmp_path_factory: pytest.TempPathFactory, testrun_uid: str) -> Project:
    """The project after one complete run of everything, which all processes of the tests share: a project may be moved.
    Tests leave it as it is, or take `changeable`."""
    shared = tmp_path_factory.getbasetemp().parent / f"finished-{testrun_uid}"
    with alone(shared.with_suffix(".lock")):
        if not shared.exists():
            made = Project(tmp_path_factory.mktemp("made") / "fingerpad")
            shutil.copytree(project.folder, made.folder)
            run = made.snakemake("all")
            assert run.status == 0, run.text
            made.folder.rename(shared)
    return Project(shutil.copytree(shared, tmp_path_factory.mktemp("finished") / "fingerpad", symlinks=True))


@pytest.fixture
def changeable(finished: Project, tmp_path: Path) -> Iterator[Project]:
    """A copy of the finished project, for a test that changes it."""
    folder = tmp_path / "changeable"
    yield Project(shutil.copytree(finished.folder, folder, symlinks=True))
    shutil.rmtree(folder)


def coarsened(config: str) -> str:
    """The text of config.yaml with a coarse mesh."""
    for key, factor in COARSER.items():
        config = re.sub(
            rf"(\b{key}: {{value: )([\d.]+)",
            lambda found, factor=factor: f"{found[1]}{factor * float(found[2])}",
            config,
        )
    return config


@pytest.fixture(scope="session")
def coarse_scenes(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Scenes with Device 2 alone, on a coarse mesh."""
    folder = tmp_path_factory.mktemp("scenes")
    (folder / "devices").mkdir()
    shutil.copy2(project.folder / "config/devices/device2.yaml", folder / "devices")
    text = (project.folder / "config/config.yaml").read_text(encoding="utf-8")
    (folder / "config.yaml").write_text(coarsened(text), encoding="utf-8")
    return folder


@pytest.fixture(scope="session")
def both_scenes(coarse_scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The coarse scenes with both kinematics, another span than the shipped one, and SMALL_ONLY: Device 2 again, whose
    file leaves the finite ones out.
    """
    scenes = tmp_path_factory.mktemp("both") / "scenes"
    shutil.copytree(coarse_scenes, scenes)
    text = (scenes / "devices" / "device2.yaml").read_text(encoding="utf-8")
    key = 'kinematics: {value: small, unit: "1", source: "assumption: a test"}\n'
    (scenes / "devices" / f"{SMALL_ONLY}.yaml").write_text(f"{text}\n{key}", encoding="utf-8")
    Project(scenes).edit("config.yaml", lambda text: text.replace("{value: small", "{value: both", 1))
    Project(scenes).edit(
        "config.yaml", lambda text: text.replace("span_margin: {value: 1.12", "span_margin: {value: 0.5")
    )
    return scenes


@pytest.fixture(scope="session")
def finite_run(project: Project, both_scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> Project:
    """Results of a complete run of the coarse scenes with both kinematics."""
    there = Project(tmp_path_factory.mktemp("finite"))
    run = project.snakemake("all", *into(there.folder, both_scenes))
    assert run.status == 0, run.text
    return there


def into(there: Path, scenes: Path) -> tuple[str | Path, ...]:
    """Arguments of Snakemake for results of these scenes in another folder."""
    return "--directory", there, "--config", f"scenes={scenes}"


def coarse_run(scenes: Path, there: Path) -> tuple[str | Path, ...]:
    """Arguments of Snakemake for a table and a figure of these scenes, with results in another folder."""
    return *TABLE_AND_FIGURE, *into(there, scenes)


def results(folder: Path) -> dict[str, str]:
    """Checksums of all results in a folder but for logs and times."""
    found = Project(folder).files("results")
    return {name: checksum for name, (_, checksum) in found.items() if not name.startswith(NOT_RESULTS)}


@pytest.fixture(scope="session")
def undisturbed(project: Project, coarse_scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Results of `coarse_run` that nothing disturbs."""
    folder = tmp_path_factory.mktemp("undisturbed")
    run = project.snakemake(*coarse_run(coarse_scenes, folder))
    assert run.status == 0, run.text
    return results(folder)
