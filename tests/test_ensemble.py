"""The ensemble over assumptions: what is varied, that nothing else is, and what its tables say."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import yaml

from fingerpad.contact.solution import Solution
from fingerpad.ensemble.alternatives import (
    AS_CONFIGURED,
    FIRST,
    HALF_CYCLES,
    SECOND,
    Alternative,
    member_scenes,
    named_alternative,
    read_ensemble,
    slug,
    write_scenes,
)
from fingerpad.ensemble.members import EnsembleTables, ensemble_tables, member_scores
from fingerpad.ensemble.robustness import absent_keys, changed, orders_held, reasons, varied_values
from fingerpad.errors import ContactError, SceneError
from fingerpad.figures.ensemble import TIMES, ensemble_figure
from fingerpad.pages.robustness import robustness_values
from fingerpad.perception.correlation import correlation_table
from fingerpad.prediction import scoring
from fingerpad.readouts.roughness import SERIES
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.validation import check_device
from fingerpad.scene.variation import with_value
from fingerpad.scene.yamlfile import read_yaml
from literature import LITERATURE
from scenes import scene
from test_claims import make_scores

ROOT = Path(__file__).parents[1]
SCHEMAS = ROOT / "workflow" / "schemas"
SHIPPED = ROOT / "config" / "ensemble.yaml"
CONFIG = read_yaml(ROOT / "config" / "config.yaml")
DEVICES = {path.stem: read_yaml(path) for path in sorted((ROOT / "config" / "devices").glob("device?.yaml"))}
FRICTION = Alternative("model", "contact.friction", 0.38, None, "Buchholz et al. 1988")
DENSER = Alternative("devices", "actuators.pitch", None, 0.8, "assumption: a denser row")


def test_a_condition_that_cannot_be_solved_leaves_a_member_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    def stimulate(*given: Any) -> Solution:
        if given[-1].name == "alternate_090":
            raise ContactError("too far")
        return stimulated(*given)

    stimulated = scoring.stimulate
    monkeypatch.setattr(scoring, "stimulate", stimulate)
    rows = member_scores([scene("device2").coarsened(4.0)], Kinematics.SMALL, FRICTION, FIRST)
    assert {row["condition"] for row in rows if row["score"] is None} == {"alternate_090"}
    assert {row["note"] for row in rows if row["score"] is None} == {"no prediction: too far"}
    assert len({row["condition"] for row in rows}) == 3
    assert {(row["half_cycle"], row["varied"]) for row in rows} == {(FIRST, FRICTION.name)}


@pytest.mark.parametrize("alternative", [None, *read_ensemble(SHIPPED)], ids=lambda each: each.name if each else "none")
def test_every_member_is_a_folder_of_valid_scenes(alternative: Alternative | None, tmp_path: Path) -> None:
    config, devices = write_scenes(tmp_path, CONFIG, DEVICES, alternative, SECOND)
    assert devices
    for path in devices:
        scene = check_device(path, SCHEMAS, config)
        assert read_yaml(path)["stimulus"]["half_cycle"]["value"] == SECOND
        assert scene.device.name in DEVICES


def test_members_have_names_of_their_own() -> None:
    alternatives = read_ensemble(SHIPPED)
    assert len({slug(each.name) for each in alternatives} | {slug(AS_CONFIGURED)}) == len(alternatives) + 1
    assert named_alternative(alternatives, slug(AS_CONFIGURED)) is None
    assert named_alternative(alternatives, slug(alternatives[3].name)) == alternatives[3]
    with pytest.raises(SceneError, match="found the member nobody"):
        named_alternative(alternatives, "nobody")


def test_one_value_changes_and_says_so() -> None:
    scenes = member_scenes(CONFIG, DEVICES, FRICTION, FIRST)
    assert scenes.config["contact"]["friction"] == {
        "value": 0.38,
        "unit": "1",
        "source": "varied: Buchholz et al. 1988",
    }
    scenes.config["contact"]["friction"] = CONFIG["contact"]["friction"]
    assert scenes.config == CONFIG
    assert scenes.devices.keys() == DEVICES.keys()


def test_devices_vary_in_what_they_assume_alone() -> None:
    """Device 2's pitch is assumed, those of the others are known."""
    scenes = member_scenes(CONFIG, DEVICES, DENSER, FIRST)
    assert list(scenes.devices) == ["device2"]
    assert scenes.devices["device2"]["actuators"]["pitch"]["value"] == 2.0
    assert DEVICES["device2"]["actuators"]["pitch"]["value"] == 2.5


def test_the_second_half_cycle_turns_every_displacement_round(tmp_path: Path) -> None:
    found = {}
    for half_cycle in HALF_CYCLES:
        folder = tmp_path / half_cycle
        config, devices = write_scenes(folder, CONFIG, DEVICES, None, half_cycle)
        found[half_cycle] = [check_device(path, SCHEMAS, config).device.conditions for path in devices]
    for first, second in zip(*found.values(), strict=True):
        for one, other in zip(first, second, strict=True):
            np.testing.assert_array_equal(one.normal, -other.normal)
            np.testing.assert_array_equal(one.tangential, -other.tangential)


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"finger": []}, "found the key finger; allowed: model, devices"),
        ({"model": [{"key": "contact.friction", "values": [1.0]}]}, r"model\[0\]: found .*; allowed: the keys key"),
        ({"model": [{"key": "a", "values": 1.0, "source": "s"}]}, "allowed: a list of one or more"),
        (
            {"model": [{"key": "a", "times": ["x"], "source": "s"}]},
            "allowed: a list of one or more, numbers under times",
        ),
        ({"devices": [{"key": "a", "values": [], "source": "s"}]}, r"found \[\]; allowed: a list of one or more"),
        (
            {"model": [{"key": key, "values": [9.0], "source": "s"} for key in ("a.b", "a_b")]},
            r"found a\.b 9\.0 and a_b 9\.0, which share a file name",
        ),
    ],
)
def test_bad_alternatives_are_named(document: dict[str, object], said: str, tmp_path: Path) -> None:
    path = tmp_path / "ensemble.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    with pytest.raises(SceneError, match=said):
        read_ensemble(path)


@pytest.mark.parametrize(
    ("alternative", "said"),
    [
        (Alternative("model", "contact.fricton", 0.1, None, "s"), "contact.fricton: found no such value"),
        (
            Alternative("devices", "actuators.ptich", None, 2.0, "s"),
            r"no device here assumes a value actuators.ptich; did you mean actuators.pitch\?",
        ),
        (Alternative("devices", "title", None, 2.0, "s"), "no device here assumes a value title$"),
        (Alternative("model", "readout.side", None, 2.0, "s"), "found 'dermis'; allowed: a number"),
    ],
)
def test_what_cannot_be_varied_is_named(alternative: Alternative, said: str) -> None:
    with pytest.raises(SceneError, match=said):
        member_scenes(CONFIG, DEVICES, alternative, FIRST)


def test_devices_without_half_cycles_have_no_ensemble() -> None:
    with pytest.raises(SceneError, match=r"no device has a value stimulus\.half_cycle"):
        member_scenes(CONFIG, {}, None, FIRST)


@pytest.fixture(scope="module")
def tables() -> EnsembleTables:
    """Scores as the paper says; with less friction Device 2's strain falls, and in the second half-cycle Device 3's
    strain is as good as level: its errors, as large a share of the scores as those of 1 to 3, are 0.07 and more."""
    usual, less = make_scores(), make_scores({("device2", "shear", "strain"): [3, 2, 1]})
    level = make_scores({("device3", "shear", "strain"): [200.0, 200.01, 200.02]})
    members = [
        usual.assign(half_cycle=FIRST, varied=AS_CONFIGURED),
        level.assign(half_cycle=SECOND, varied=AS_CONFIGURED),
        *(less[less["device"] == "device2"].assign(half_cycle=each, varied=FRICTION.name) for each in HALF_CYCLES),
    ]
    return ensemble_tables(
        pd.concat(members).drop(columns="score_error"),
        usual,
        replace(LITERATURE, ratings=LITERATURE.ratings.assign(kind="measured")),
    )


def test_verdicts_of_members_are_those_of_their_scores(tables: EnsembleTables) -> None:
    """Devices that a member leaves as they are keep their scores; errors follow those of the scenes as configured."""
    assert len(tables.claims) == 4 * 21
    verdict = tables.claims.set_index(["half_cycle", "varied", "claim"])["holds"]
    turned = verdict[verdict != "yes"].to_dict()
    strain2, strain3 = "Device 2: the strain correlates well.", "Device 3: the strain correlates negatively."
    assert turned == {
        (FIRST, FRICTION.name, strain2): "no",
        (SECOND, FRICTION.name, strain2): "no",
        (SECOND, AS_CONFIGURED, strain3): "undecided",
        (SECOND, FRICTION.name, strain3): "undecided",
    }
    assert set(tables.correlations["varied"]) == {AS_CONFIGURED, FRICTION.name}


def test_page_counts_members_and_names_what_turns_a_statement(tables: EnsembleTables) -> None:
    values = robustness_values(vars(tables))
    assert values["members"] == 2
    row = next(
        line for line in str(values["statements"]).splitlines() if "Device 2: the strain correlates well" in line
    )
    assert row.count("yes, 1 of 2 | contact.friction 0.38") == 2
    assert "Device 2: the strain correlates well" not in str(values["always"])
    assert "- Device 1: the change of strain correlates very well." in str(values["always"])
    assert "- Device 1: leaving out shear matters less than for Device 2. *(weaker)*" in str(values["always"])
    counted = str(values["correlations"])
    assert "| small | device2 | strain | 0.989, rising | 1, rising | 1, rising | 2 of 4 |" in counted
    # a member with less friction has Device 3's scores as configured, and does not count for it
    assert "| small | device3 | change_of_strain | 0.959, rising | 1, rising | 1, rising | 2 of 2 |" in counted


def test_page_has_scores_of_both_halves_and_names_what_has_no_solution(tables: EnsembleTables) -> None:
    values = robustness_values(vars(tables))
    assert values["unsolved"] == "None."
    assert "| small | device1 | strain | 1.00 (`low_000`) | 1.00 (`low_000`) |" in str(values["halves"])
    level = next(line for line in str(values["halves"]).splitlines() if "device3 | strain" in line)
    assert level == f"| small | device3 | strain | {level_ratio(tables.scores)} |"
    scores = tables.scores
    lost = scores["varied"].eq(FRICTION.name) & scores["device"].eq("device2")
    assert lost.any()
    unsolved = scores.assign(score=scores["score"].mask(lost), note=scores["note"].mask(lost, "no prediction: too far"))
    told = robustness_values(vars(replace(tables, scores=unsolved)))
    assert told["unsolved"] == "- `contact.friction 0.38`, small kinematics: too far"


def level_ratio(scores: pd.DataFrame) -> str:
    """The table's cells of Device 3's strain: what the second half-cycle makes of its least and most raised score."""
    own = scores[(scores["device"] == "device3") & (scores["readout"] == "strain") & (scores["interface"] == "shear")]
    own = own[own["varied"] == AS_CONFIGURED].set_index(["half_cycle", "condition"])["score"]
    ratio = own[SECOND] / own[FIRST]
    return " | ".join(f"{ratio[name]:.2f} (`{name}`)" for name in (ratio.idxmin(), ratio.idxmax()))


def test_figure_of_devices_that_the_paper_does_not_know_says_so(tables: EnsembleTables) -> None:
    """Their table has its header alone."""
    (axes,) = ensemble_figure(tables.claims[:0]).axes
    assert [text.get_text() for text in axes.texts] == ["no statement: these are about the paper's devices"]


def test_figure_has_a_mark_for_every_verdict(tables: EnsembleTables) -> None:
    """But for those whose numbers do not change, as another device's do not."""
    figure = ensemble_figure(tables.claims)
    figure.draw_without_rendering()
    marks = sum(len(line.get_xdata()) for line in figure.axes[0].lines if line.get_linestyle() == "None")
    told = ["claim", "half_cycle", "evidence"]
    varied = tables.claims[tables.claims["varied"] != AS_CONFIGURED]
    idle = varied.merge(tables.claims[tables.claims["varied"] == AS_CONFIGURED], on=told)
    assert 0 < len(idle) < len(varied)
    assert marks == len(tables.claims) - len(idle)
    assert [label.get_text() for label in figure.axes[0].get_yticklabels()] == [
        AS_CONFIGURED,
        "contact",
        "friction 0.38",
    ]


def test_figure_sets_members_of_a_group_beside_each_other_under_its_name(tables: EnsembleTables) -> None:
    """In the order of the model and then the device, whatever the table's; marks stand over their members' names."""
    usual = tables.claims[tables.claims["varied"] == AS_CONFIGURED]
    members = [
        "stimulus.playback cycle",
        "contact.friction 0.2",
        "finger.pad.dermis.modulus times 2",
        "tissue.law ogden",
    ]
    varied = [usual.assign(varied=each, evidence=each, holds="no") for each in members]
    figure = ensemble_figure(pd.concat([usual, *varied]))
    figure.draw_without_rendering()
    (axes,) = figure.axes
    named = [label.get_text() for label in axes.get_yticklabels()]
    expected = [AS_CONFIGURED, "finger", f"dermis modulus {TIMES} 2", "law ogden", "contact", "friction 0.2"]
    assert named == [*expected, "device", "playback cycle"]
    (crosses,) = [line for line in axes.lines if line.get_marker() == "x"]
    assert {named[int(y)] for y in crosses.get_ydata()} >= set(named) - {AS_CONFIGURED, "finger", "contact", "device"}
    labels = [label.get_window_extent() for label in axes.get_yticklabels()]
    assert all(one.y0 >= other.y1 - 0.5 for one, other in pairwise(labels))  # px: none runs into the next


def test_figure_tells_what_has_no_solution_from_what_does_not_change(tables: EnsembleTables) -> None:
    claims = tables.claims
    lost = (claims["varied"] == FRICTION.name) & claims["claim"].str.startswith("Device 3")
    assert lost.any()
    figure = ensemble_figure(claims[~lost])
    dashes = sum(len(line.get_xdata()) for line in figure.axes[0].lines if line.get_marker() == "_")
    assert dashes == lost.sum()
    assert "no solution" in [text.get_text() for text in figure.legends[0].get_texts()]
    assert "no solution" not in [text.get_text() for text in ensemble_figure(claims).legends[0].get_texts()]


def test_a_device_varies_in_what_it_assumes_and_in_what_its_model_may_be() -> None:
    """What another device has, what is known and what is as it is already are no variants."""
    varied = varied_values(CONFIG, DEVICES["device2"], read_ensemble(SHIPPED))
    assert varied["finger.height times 0.9"] == {"finger.height": 11.7}
    assert varied["actuators.pitch times 0.8"] == {"actuators.pitch": 2.0}
    assert varied["stimulus.half_cycle second"] == {"stimulus.half_cycle": SECOND}
    assert "stimulus.dispersions.low" in absent_keys(DEVICES["device2"], read_ensemble(SHIPPED))
    assert "actuators.pitch" not in absent_keys(DEVICES["device2"], read_ensemble(SHIPPED))
    keys = {key for values in varied.values() for key in values}
    assert not keys & {"actuators.body.poisson", "stimulus.relative_to", "stimulus.dispersions.low"}
    known = with_value(DEVICES["device2"], "actuators.pitch", 2.5, "our data sheet")
    assert "actuators.pitch times 0.8" not in varied_values(CONFIG, known, read_ensemble(SHIPPED))
    already = with_value(CONFIG, "contact.friction", 0.38, "measured")
    assert "contact.friction 0.38" not in varied_values(already, known, read_ensemble(SHIPPED))
    for source, varies in {"assumption: as steel": True, "our data sheet": False}.items():
        own = {**known, "contact": {"friction": {"value": 0.3, "unit": "1", "source": source}}}
        assert ("contact.friction 0.38" in varied_values(CONFIG, own, read_ensemble(SHIPPED))) is varies
        member = member_scenes(CONFIG, {"device2": own}, FRICTION, FIRST).devices["device2"]
        assert member["contact"]["friction"]["value"] == (0.38 if varies else 0.3)
    with pytest.raises(SceneError, match=r"contact\.fricton: found no such value"):
        varied_values(CONFIG, known, [Alternative("model", "contact.fricton", 0.1, None, "s")])
    of_devices = Alternative("devices", "contact.friction", 0.1, None, "s")  # which this one leaves to the model
    assert of_devices.name not in varied_values(CONFIG, DEVICES["device2"], [of_devices])


def table_of(**scores: float | None) -> list[dict[str, Any]]:
    """Rows of one interface and read-out, with errors of a tenth."""
    return [
        {"condition": name, "interface": "shear", "readout": "strain", "score": score, "note": "" if score else "lost"}
        | {"score_error": score and 0.1 * score}
        for name, score in scores.items()
    ]


def test_orders_hold_are_open_turn_or_are_lost() -> None:
    """Errors of members are a tenth of their scores, too, 0.3 and 0.355: 3 and 3.55 are open."""
    configured = table_of(a=1.0, b=2.0, c=3.0)
    members = {"like": table_of(a=10.0, b=20.0, c=30.0), "near": table_of(a=1.0, b=3.0, c=3.55),
               "turns": table_of(a=1.0, b=3.0, c=2.0), "none": table_of(a=1.0, b=2.0, c=None)}  # fmt: skip
    first, outer, last = orders_held(configured, members)
    assert (first.low, first.high, first.holds) == ("a", "b", ("like", "near", "turns", "none"))
    assert (outer.low, outer.high, outer.holds) == ("a", "c", ("like", "near", "turns"))
    assert (last.low, last.high) == ("b", "c")
    assert (last.holds, last.open, last.reversed, last.lost) == (("like",), ("near",), ("turns",), ("none",))
    assert (first.scored, last.scored) == (4, 3)
    assert [(each.low, each.high) for each in orders_held(configured, {"like": configured})] == [("a", "b"), ("b", "c")]
    assert reasons(configured, members["none"]) == ["lost"]
    assert not reasons(table_of(a=1.0, b=2.0, c=None), members["none"])


def test_a_score_that_is_another_or_gone_has_changed() -> None:
    configured = table_of(a=1.0, b=None)
    assert not changed(configured, table_of(a=1.0 + 1e-9, b=None))
    assert changed(configured, table_of(a=1.01, b=None))
    assert changed(configured, table_of(a=0.99, b=None))
    assert changed(configured, table_of(a=None, b=None))


def test_implied_orders_are_left_out_where_a_member_is_lost() -> None:
    configured = table_of(a=1.0, b=2.0, c=3.0)
    told = orders_held(configured, {"like": configured, "none": table_of(a=1.0, b=2.0, c=None)})
    assert [(each.low, each.high) for each in told] == [("a", "b"), ("b", "c")]


def test_an_order_that_holds_where_others_are_lost_is_told() -> None:
    configured = table_of(a=1.0, b=2.0, c=3.0)
    told = orders_held(configured, {"like": configured, "gap": table_of(a=1.0, b=None, c=3.0)})
    assert [(each.low, each.high, len(each.holds)) for each in told] == [("a", "b", 1), ("a", "c", 2), ("b", "c", 1)]


def test_an_order_without_a_prediction_is_not_certain() -> None:
    configured = table_of(a=1.0, b=2.0, c=3.0)
    told = orders_held(configured, {"none": table_of(a=None, b=None, c=None)})
    assert len(told) == 3
    assert not any(each.is_certain for each in told)
    assert all(each.is_certain for each in orders_held(configured, {"like": configured}))


def test_a_score_of_nothing_keeps_its_error_as_long_as_it_is_nothing() -> None:
    """As that of a condition that moves nothing; of another score no error is known."""
    configured = table_of(a=0.0, b=2.0)
    (found,) = orders_held(configured, {"like": table_of(a=0.0, b=3.0), "more": table_of(a=0.1, b=2.0)})
    assert (found.holds, found.open) == (("like",), ("more",))


def test_members_leave_out_kinematics_that_a_device_does() -> None:
    own = scene("device2")
    small = own.with_device(kinematics=(Kinematics.SMALL,)).coarsened(8.0)
    assert member_scores([small], Kinematics.FINITE, None, FIRST) == []


def test_members_have_rows_of_what_is_not_predicted() -> None:
    """As the score table of device 3, whose motion is not prescribed without friction."""
    rows = member_scores([scene("device3").coarsened(4.0)], Kinematics.SMALL, None, FIRST)
    silent = [row for row in rows if row["interface"] == Interface.FRICTIONLESS]
    assert len(silent) == len(rows) / 2
    assert {(row["score"], row["note"]) for row in silent} == {(None, "no prediction")}


def test_the_scenes_as_configured_have_their_own_errors() -> None:
    """As a member of the ensemble, whose errors are relative ones of the score table."""
    recorded = pd.read_csv(ROOT / "tests" / "expected" / "scores.csv")
    members = recorded.drop(columns="score_error").assign(half_cycle=FIRST, varied=AS_CONFIGURED)
    correlations = ensemble_tables(members, recorded, LITERATURE).correlations
    expected = correlation_table(recorded, LITERATURE)
    both = correlations.merge(expected, on=SERIES, suffixes=("", "_expected"))
    assert len(both) == len(expected)
    np.testing.assert_allclose(both["r_error"], both["r_error_expected"], rtol=1e-9)
