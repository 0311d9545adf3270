"""Stimuli: the kinds that there are, drives in both directions, and displacements that were measured."""

from __future__ import annotations

import itertools
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from fingerpad.errors import SceneError
from fingerpad.scene.device import ActuatorRow, Condition, Control, Cycle, Device
from fingerpad.scene.recording import FARTHEST, LATEST, MOST_TIMES, read_recording
from fingerpad.scene.scenefile import recordings
from fingerpad.scene.stimuli import KINDS, SETTLING, alternating, alternating_cycles, measured, phased, phased_cycles
from fingerpad.scene.validation import check_device
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.vibration import cycling

ROOT = Path(__file__).parents[1]
SCHEMAS = ROOT / "workflow" / "schemas"
CONFIG = ROOT / "config" / "config.yaml"
SECOND = ROOT / "config" / "devices" / "device2.yaml"
HEADER = "time,actuator,normal,tangential\n"
GOOD = ["0.5,1,0.01,0", "0.5,2,0,0", "1,1,0,0.02", "1,2,-0.01,0"]
PHASED = {"amplitude": 0.02, "playback": "snapshot", "phases": [0, 180], "dispersions": {"all": [0, 1]}}

ROWS = [{"phase": 0, "absolute": 0.2, "relative": 0.01}]
NEIGHBOURS = {"rows": ROWS, "relative_to": "neighbour"}


def test_kinds_are_those_of_the_schema() -> None:
    schema = yaml.safe_load((SCHEMAS / "device.schema.yaml").read_text(encoding="utf-8"))
    stimulus = schema["properties"]["stimulus"]
    assert stimulus["properties"]["kind"]["enum"] == list(KINDS)
    branches = {
        case["if"]["properties"]["kind"]["const"]: case["then"]["$ref"].removeprefix("#/$defs/")
        for case in stimulus["allOf"]
    }
    assert branches == {name: name for name in KINDS}
    assert schema["$defs"].keys() >= KINDS.keys()


def test_limits_of_a_recording_are_those_of_a_history() -> None:
    definitions = yaml.safe_load((SCHEMAS / "device.schema.yaml").read_text(encoding="utf-8"))["$defs"]
    time = definitions["history"]["properties"]["histories"]["additionalProperties"]["properties"]["time"]
    assert time["properties"]["value"]["items"]["maximum"] == LATEST
    assert time["properties"]["value"]["maxItems"] == MOST_TIMES
    number = definitions["displacements"]["properties"]["value"]["items"]["items"]
    assert (number["minimum"], number["maximum"]) == (-FARTHEST, FARTHEST)


@pytest.mark.parametrize(
    ("relative_to", "moved"),
    [
        ("neighbour", [0.205, 0.195, 0.205, 0.195, 0.205]),
        ("row", [0.21, 0.19, 0.21, 0.19, 0.21]),
        ("leader", [0.2, 0.19, 0.2, 0.19, 0.2]),
    ],
)
def test_what_a_relative_displacement_is_relative_to(relative_to: str, moved: list[float]) -> None:
    stimulus = {**NEIGHBOURS, "relative_to": relative_to, "direction": "lateral", "half_cycle": "first"}
    (condition,) = alternating(stimulus, 5, ROOT)
    (cycle,) = alternating_cycles(stimulus, 5)
    np.testing.assert_allclose(condition.tangential, [moved], rtol=1e-12)  # but for rounding
    np.testing.assert_allclose(cycle.tangential, moved, rtol=1e-12)


@pytest.mark.parametrize(
    ("direction", "normal", "tangential"), [("normal", 1, 0), ("lateral", 0, 1), ("both", 1, 1)], ids=str
)
def test_direction_says_where_actuators_move(direction: str, normal: int, tangential: int) -> None:
    for half_cycle, sign in (("first", 1.0), ("second", -1.0)):
        drive = {"direction": direction, "half_cycle": half_cycle}
        made = [
            (phased({**PHASED, **drive}, 2, ROOT)[1], [[0.02, -0.02]]),
            (alternating({**NEIGHBOURS, **drive}, 2, ROOT)[0], [[0.205, 0.195]]),
        ]
        for condition, displacement in made:
            assert condition.normal == pytest.approx(sign * normal * np.array(displacement))
            assert condition.tangential == pytest.approx(sign * tangential * np.array(displacement))


def test_a_phase_may_have_decimals() -> None:
    """Names of conditions are what folders and wildcards may be, and tell apart what differs in the last digit."""
    phases = [0, 22.0, 22.5, 22.50000001, 1e-7, 360]
    drive = {"direction": "normal", "half_cycle": "first"}
    stimulus = {**PHASED, **drive, "phases": phases}
    rows = {**NEIGHBOURS, "rows": [{**ROWS[0], "phase": phase} for phase in phases], **drive}
    for made, cycles in (
        (phased(stimulus, 2, ROOT), phased_cycles(stimulus, 2)),
        (alternating(rows, 2, ROOT), alternating_cycles(rows, 2)),
    ):
        names = [condition.name for condition in made]
        assert all(re.fullmatch("[a-z][a-z0-9_]*", name) for name in names)
        assert len(set(names)) == len(phases)
        assert names == [cycle.name for cycle in cycles]
        assert [name.split("_", 1)[1] for name in names[:3]] == ["000", "022", "022_5"]


@pytest.mark.parametrize("playback", ["snapshot", "cycle"])
def test_a_snapshot_does_not_tell_where_a_wave_runs(playback: str) -> None:
    """At phases p and 360 - p pins ahead by 0, 1, 2, ... are in one place, to the last digit, at the first one's peak;
    they are not on the way there.
    """
    count, phases = 64, [37.3, 60, 120, 240, 300, 322.7]
    stimulus = {**PHASED, "direction": "normal", "half_cycle": "first", "phases": phases, "playback": playback}
    stimulus["dispersions"] = {"wave": list(range(count))}
    made = phased(stimulus, count, ROOT)
    for one, other in zip(made[:3], made[:2:-1], strict=True):
        assert one.same_stimulus(other) is (playback == "snapshot")


def test_waves_run_from_pins_that_are_ahead() -> None:
    """As vibrations and played in time: pin i is ahead by i quarters of a period, at A cos or A sin of w t + k_i p."""
    stimulus = {**PHASED, "direction": "normal", "half_cycle": "first", "phases": [90], "playback": "cycle"}
    stimulus["dispersions"] = {"wave": [0, 1, 2]}
    ahead = np.radians([0.0, 90.0, 180.0])
    (cycle,), (played,) = phased_cycles(stimulus, 3), phased(stimulus, 3, ROOT)
    # but for rounding
    assert cycling.displacement(cycle, 0.7)[:, 1] == pytest.approx(0.02 * np.cos(0.7 + ahead), abs=1e-12)
    expected = 0.02 * np.sin(2.0 * np.pi * played.time[:, None] + ahead)
    assert played.normal == pytest.approx(expected, abs=1e-12)


def test_a_snapshot_needs_an_actuator_whose_peak_it_is() -> None:
    """Without one, all could be at their zero crossings, and nothing would say so."""
    stimulus = {**PHASED, "direction": "normal", "half_cycle": "first", "dispersions": {"late": [1, 1]}}
    with pytest.raises(
        SceneError, match=r"stimulus\.dispersions\.late: found \[1, 1\]; allowed: at least one group index 0"
    ):
        phased(stimulus, 2, ROOT)
    (made, _) = phased({**stimulus, "playback": "cycle"}, 2, ROOT)
    assert made.time[made.settling - 1] == SETTLING
    assert made.time[-1] == SETTLING + 1.0


def narrow(cycles: bool, tangential: list[list[float]]) -> Device:
    """Three actuators with gaps of 0.05 mm, as pins that move in time [1, 2] s or vibrate."""
    row, path = ActuatorRow((-2.05, 0.0, 2.05), 2.0, 0.3), np.array(tangential)
    still = np.zeros_like(path)
    moving = Condition("rub", "one", 0.0, np.array([1.0, 2.0]), still, still if cycles else path)
    turning = Cycle("rub", "one", 0.0, still[0] + 0j, path[0] * np.exp(1j * np.array([0.0, 2.0, 2.0])))
    return Device("d", "D", Control.DISPLACEMENT, row, (moving,), (turning,) if cycles else ())


def test_actuators_do_not_run_through_each_other() -> None:
    """At any time of a stimulus; apart, together or by no more than their gap they may move."""
    narrow(False, [[-9.0, 0.0, 9.0], [0.0, -0.05, -0.1]])
    said = r"d: condition rub, time 2 s: actuators 2 and 3 run into each other: they come 0\.2 mm closer and overlap by"
    with pytest.raises(SceneError, match=said + r" 0\.15 mm; allowed: strokes within their gap of 0\.05 mm"):
        narrow(False, [[0.0, 0.0, 0.0], [0.0, 0.1, -0.1]])


def test_actuators_do_not_run_through_each_other_in_a_cycle() -> None:
    """They come as close as phases let them: not as close as amplitudes would."""
    farthest = 0.05 / abs(1.0 - np.exp(2j))
    narrow(True, [[farthest] * 3, [0.0] * 3])
    with pytest.raises(SceneError, match="condition rub, as a vibration: actuators 1 and 2 run into each other"):
        narrow(True, [[1.01 * farthest] * 3, [0.0] * 3])


def written(folder: Path, lines: list[str], header: str = HEADER) -> Path:
    path = folder / "tap.csv"
    path.write_text(header + "\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("lines", [*itertools.permutations(GOOD)])
def test_recording_is_read_in_any_order(tmp_path: Path, lines: tuple[str, ...]) -> None:
    """Also where the last time comes first."""
    found = read_recording(written(tmp_path, [*lines]), 2)
    assert found.time.tolist() == [0.5, 1.0]
    assert found.normal.tolist() == [[0.01, 0.0], [0.0, -0.01]]
    assert found.tangential.tolist() == [[0.0, 0.0], [0.02, 0.0]]


@pytest.mark.parametrize("first", [0.0, 0.5])
def test_no_two_states_have_one_time(first: float) -> None:
    """Also where a recording begins at 0, which is another state than the pre-indented one."""
    row = np.zeros((3, 1))
    times = Condition("tap", "one", 0.0, first + np.arange(3.0), row, row).times
    assert times[1] == first
    assert np.all(np.diff(times) > 0.0)


def test_columns_come_in_any_order(tmp_path: Path) -> None:
    lines = [",".join(reversed(line.split(","))) for line in GOOD]
    header = ",".join(reversed(HEADER.strip().split(","))) + "\n"
    assert read_recording(written(tmp_path, lines, header), 2).normal[0, 0] == 0.01


def device(folder: Path, file: str) -> Path:
    """A device of four actuators with one measured condition."""
    document = yaml.safe_load(SECOND.read_text(encoding="utf-8"))
    given = {"dispersion": ("one", "1"), "phase": (0, "deg"), "file": (file, "1")}
    document["stimulus"] = {
        "kind": "measured",
        "recordings": {
            "tap": {
                key: {"value": value, "unit": unit, "source": "assumption: test"}
                for key, (value, unit) in given.items()
            }
        },
    }
    path = folder / "mine.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    return path


def test_measured_device_is_the_one_with_that_history(tmp_path: Path) -> None:
    (tmp_path / "raw").mkdir()
    written(tmp_path / "raw", [f"1,{k},0.0{k},-0.0{k}" for k in range(1, 5)])
    path = device(tmp_path, "raw/tap.csv")
    (condition,) = check_device(path, SCHEMAS, CONFIG).device.conditions
    moved = np.array([[0.01, 0.02, 0.03, 0.04]])
    assert condition.same_stimulus(Condition("tap", "one", 0.0, np.array([1.0]), moved, -moved))
    with pytest.raises(SceneError, match="settling must leave a time to read of 1, found 1"):
        Condition("tap", "one", 0.0, np.array([1.0]), moved, -moved, settling=1)
    assert recordings(path) == [tmp_path / "raw" / "tap.csv"]
    assert recordings(SECOND) == []


@pytest.mark.parametrize(
    "file", ["../tap.csv", "raw/../tap.csv", "/tap.csv", "~/tap.csv", ".tap.csv", "tap.txt", "a b.csv", "tap.csv\n"]
)
def test_recording_lies_with_the_device(tmp_path: Path, file: str) -> None:
    with pytest.raises(SceneError, match=r"stimulus.recordings.tap.file.value: found .* in the device file's folder"):
        check_device(device(tmp_path, file), SCHEMAS, CONFIG)


def test_a_file_that_never_ends_is_not_read(tmp_path: Path) -> None:
    """Neither as a recording nor as a scene file: a link to a device, or a pipe that waits for its writer."""
    pipe, link = tmp_path / "pipe.csv", tmp_path / "zero.csv"
    os.mkfifo(pipe)
    link.symlink_to("/dev/zero")
    for path in (pipe, link):
        with pytest.raises(SceneError, match=r"\.csv: is no file that ends; allowed: a CSV file"):
            read_recording(path, 4)
        with pytest.raises(SceneError, match=r"\.csv: is no file that ends; allowed: a YAML file"):
            read_yaml(path)


def test_mistake_names_device_file_key_and_recording(tmp_path: Path) -> None:
    path = device(tmp_path, "tap.csv")
    with pytest.raises(SceneError, match="cannot be read: No such file"):
        check_device(path, SCHEMAS, CONFIG)
    written(tmp_path, GOOD)
    with pytest.raises(SceneError) as caught:
        check_device(path, SCHEMAS, CONFIG)
    said = f"{path}: stimulus.recordings.tap.file: {tmp_path / 'tap.csv'}, column actuator: found no row of actuator 3"
    assert str(caught.value).startswith(said)


def test_builder_of_recordings_reads_in_the_folder(tmp_path: Path) -> None:
    written(tmp_path, GOOD)
    given = {"recordings": {"tap": {"dispersion": "one", "phase": 90, "file": "tap.csv"}}}
    (condition,) = measured(given, 2, tmp_path)
    assert (condition.name, condition.dispersion, condition.phase_deg) == ("tap", "one", 90.0)


def test_a_recording_may_begin_at_zero(tmp_path: Path) -> None:
    found = read_recording(written(tmp_path, ["0,1,0,0", "0,2,0,0", *GOOD]), 2)
    assert found.time.tolist() == [0.0, 0.5, 1.0]


def test_a_snapshot_is_at_the_phase_with_its_decimals() -> None:
    stimulus = {**PHASED, "direction": "normal", "half_cycle": "first", "phases": [22.4]}
    (made,) = phased(stimulus, 2, ROOT)
    assert made.normal[0] == pytest.approx(0.02 * np.cos(np.radians([0.0, 22.4])), rel=1e-9)


def test_a_stroke_has_no_sign() -> None:
    row, path = ActuatorRow((-2.0, 2.0), 2.0, 0.3), np.array([[-0.02, -0.01]])
    lift = Condition("lift", "one", 0.0, np.array([1.0]), path, -path)
    pull = Condition("pull", "one", 0.0, np.array([1.0]), 0.0 * path, path)
    assert Device("d", "D", Control.DISPLACEMENT, row, (lift,)).strokes == (0.02, 0.02)
    assert Device("d", "D", Control.DISPLACEMENT, row, (pull,)).strokes == (0.0, 0.02)


@pytest.mark.parametrize("part", ["normal", "tangential", "time"])
def test_stimuli_that_differ_in_any_part_are_not_solved_as_one(part: str) -> None:
    path = np.array([[-0.02, -0.01]])
    one = Condition("one", "one", 0.0, np.array([1.0]), path, path)
    assert one.same_stimulus(replace(one, name="two"))
    assert not one.same_stimulus(replace(one, **{part: 2.0 * getattr(one, part)}))


def test_stimuli_that_are_read_from_another_time_on_are_not_solved_as_one() -> None:
    """A cycle that is read after it has settled says something else than the same path that is read anywhere."""
    path = np.array([[0.02], [-0.02]])
    one = Condition("one", "one", 0.0, np.array([1.0, 2.0]), path, path)
    assert not one.same_stimulus(replace(one, settling=1))


def test_a_path_up_to_a_time_is_read_there_alone() -> None:
    """All times before it are settling: on a coarser mesh one of them might have the larger change."""
    path = np.array([[0.02], [0.01], [-0.03], [0.0]])
    until = Condition("one", "one", 0.0, np.arange(1.0, 5.0), path, -path).until(1)
    assert until.time.tolist() == [1.0, 2.0]
    assert np.array_equal(until.moves, np.stack([-path, path], axis=2)[:2])
    assert until.settling == 1


def test_strokes_are_the_farthest_of_all_conditions() -> None:
    """In either direction, whichever condition goes there."""
    still = np.zeros((1, 2))
    conditions = tuple(
        Condition(name, name, 0.0, np.array([1.0]), still + normal, still + lateral)
        for name, normal, lateral in (("a", 0.01, -0.04), ("b", -0.03, 0.02))
    )
    device = Device("pins", "Pins", Control.DISPLACEMENT, ActuatorRow((-2.0, 2.0), 1.0, 0.1), conditions)
    assert device.strokes == (0.03, 0.04)
