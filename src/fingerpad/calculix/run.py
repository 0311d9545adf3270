"""CalculiX run on a deck, and what it prints read back: displacement of the read nodes, forces on the actuators."""

from __future__ import annotations

import os
import re
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..errors import CalculixError
from .deck import READ_NODES, DeckSettings, actuator_name
from .program import PROGRAM, installed

JOB = "scene"  # name of the deck, and so of all files that CalculiX writes
TITLE = re.compile(r"^ (\w[\w ]*) \(.*\) for set (\w+) and time", re.MULTILINE)
READ_TABLES = ("displacements", "total force")


@dataclass(frozen=True)
class Printed:
    """What CalculiX printed at the end of every move of the actuators, at rest if the deck rests.

    displacement: (n_moves, k, 2) of the read nodes [mm]. node: (k,) their index in the mesh. force: (n_moves,
    n_actuators, 2) of the actuators on the skin [N/mm].
    """

    node: np.ndarray
    displacement: FloatArray
    force: FloatArray


def run(deck: str, folder: Path, limit: float) -> tuple[Path, float]:
    """Run CalculiX on a deck in a folder, on one thread; the table of results that it prints and the seconds it took.

    limit: seconds after which it is stopped. Raises CalculixError if it is not installed, fails or is stopped.
    """
    if not installed():
        raise CalculixError(f"CalculiX: found no program {PROGRAM}; install it, as by apt-get install calculix-ccx")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{JOB}.inp").write_text(deck, encoding="utf-8")
    start = time.perf_counter()
    with (folder / f"{JOB}.log").open("w", encoding="utf-8") as log:
        try:
            done = subprocess.run(
                [PROGRAM, "-i", JOB],
                cwd=folder,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=os.environ | {"OMP_NUM_THREADS": "1"},
                timeout=limit,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise CalculixError(f"CalculiX did not end within {limit:g} s (see {folder / JOB}.log)") from None
    seconds = time.perf_counter() - start
    text = (folder / f"{JOB}.log").read_text(encoding="utf-8", errors="replace")
    if done.returncode != 0 or "Job finished" not in text:
        said = next((line.strip() for line in text.splitlines() if "*ERROR" in line), "no message")
        raise CalculixError(f"CalculiX failed: {said} (see {folder / JOB}.log)")
    return folder / f"{JOB}.dat", seconds


def read_printed(path: Path, actuators: int, moves: int, settings: DeckSettings) -> Printed:
    """Read the .dat file of a deck with that many actuators and moves of them (pre-indentation is one).

    Raises CalculixError if something is missing, or no number.
    """
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise CalculixError(f"{path}: {error.strerror}") from error
    titles = list(TITLE.finditer(text))
    stops = [title.start() for title in titles[1:]] + [len(text)]
    tables: dict[str, list[FloatArray]] = {}
    for title, stop in zip(titles, stops, strict=True):
        if title[1] in READ_TABLES:
            rows = [line.split() for line in text[title.end() : stop].splitlines()[1:] if line.strip()]
            try:
                tables.setdefault(title[2], []).append(np.array(rows, dtype=float))
            except ValueError as error:  # a Fortran number with an exponent of three digits, or a line that ends early
                raise CalculixError(f"{path}: {title[1]} of {title[2]}: {error}") from error
    wanted = [READ_NODES, *(actuator_name(number) for number in range(actuators))]
    steps = moves * settings.steps_a_move
    for name in wanted:
        if len(tables.get(name, [])) != steps:
            raise CalculixError(f"{path}: {len(tables.get(name, []))} tables of {name}, expected {steps}")
        first, *others = (table.shape for table in tables[name])
        if 0 in first or others.count(first) < len(others):
            raise CalculixError(f"{path}: tables of {name} are empty or differ in length")
    read = np.array(tables[READ_NODES])
    force = np.array([tables[name] for name in wanted[1:]])[:, :, 0, :2]
    ends = slice(settings.steps_a_move - 1, None, settings.steps_a_move)
    return Printed(read[0, :, 0].astype(int) - 1, read[ends, :, 1:3], force.swapaxes(0, 1)[ends])
