"""The workflow as its users meet it: what is planned, what reruns and what does not, and what happens when things go
wrong. All of it runs on a copy of the project; where a plan proves the point, nothing is computed.
"""

from __future__ import annotations

import functools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
import pytest

from conftest import CORES, LONGEST_RUN, ROOT, Job, Project, Run, into, results

pytestmark = pytest.mark.workflow

# The order in which snakefmt writes them
DIRECTIVES = [
    "input",
    "output",
    "log",
    "benchmark",
    "wildcard_constraints",
    "priority",
    "conda",
    "threads",
    "resources",
    "params",
    "script",
    "shell",
]
PUSHED = """
stimulus:
  kind: history
  histories:
    one:
      dispersion: {value: own, unit: "1", source: "assumption: a test"}
      phase: {value: 30, unit: deg, source: "assumption: a test"}
      time: {value: [0.1], unit: s, source: "assumption: a test"}
      normal: {value: [[0.01, 0.0, 0.0, 0.0]], unit: mm, source: "assumption: a test"}
      tangential: {value: [[0.0, 0.0, 0.0, 0.0]], unit: mm, source: "assumption: a test"}
"""
SOLVER = {"mesh", "condense", "condense_body", "solve", "filter", "score"}
TABLES = {"scores", "correlate", "claims"}
CONFIG, DEVICE = "config/config.yaml", "config/devices/device2.yaml"
ENSEMBLE = "config/ensemble.yaml"
NOTHING = "Nothing to be done"
LONG = (
    "all",
    *("accuracy", "honesty", "calculix", "calculix_orders", "frequency", "ensemble", "scorings", "notebooks"),
    "results/rule_graph.csv",
    *("results/benchmark/timings.csv", "results/figures/benchmark.png", "results/benchmark/skipping.csv"),
)  # targets
LONG_RULES = {
    *("closed_forms", "increments", "reference", "calculix", "calculix_condition", "vibrate", "frequency_variants"),
    "ensemble_member",
    *(
        "readouts",
        "phases",
        "frictions",
        "other_scores",
        "benchmark_steps",
        "benchmark_ladder",
        "benchmark_growth",
        "skipping",
    ),
}
THREADS = """
rule one:
    output:
        "results/one.txt",
    shell:
        "echo $OPENBLAS_NUM_THREADS > {output}"

rule two:
    output:
        "results/two.txt",
    threads: 2
    shell:
        "echo $OPENBLAS_NUM_THREADS > {output}"
"""
EDIT = """
rule edit:
    input:
        device=ancient(DEVICE_FILES),
    output:
        "results/edited.txt",
    shell:
        "sed -i 's/amplitude: .value: /&1/' {input.device} && touch {output}"

rule edited:
    input:
        **ALL_SCENE_FILES,
        edited="results/edited.txt",
    output:
        png="results/edited.png",
        pdf="results/edited.pdf",
    script:
        "../../scripts/figure_stimuli.py"
"""


# What is written


@dataclass(frozen=True)
class Rule:
    """A rule as it is written: its directives with their text, in the order of writing."""

    name: str
    directives: Mapping[str, str]

    @property
    def script(self) -> str:
        """The script that the rule runs, or nothing."""
        found = re.search(r"scripts/\w+\.py", self.directives.get("script", ""))
        return f"workflow/{found[0]}" if found else ""


def _written() -> Iterator[Rule]:
    for path in (ROOT / "Snakefile", *sorted((ROOT / "workflow" / "rules").glob("*.smk"))):
        text = path.read_text(encoding="utf-8")
        for _, name, body in re.findall(r"^( *)rule (\w+):\n((?:(?:\1 {4}.*)?\n)+)", text, re.MULTILINE):
            found = re.findall(r"^(\w+):(.*\n(?:(?: {4}.*)?\n)*)", textwrap.dedent(body), re.MULTILINE)
            yield Rule(name, dict(found))


RULES = {rule.name: rule for rule in _written()}
WORKING = [rule for rule in RULES.values() if "output" in rule.directives]  # the others only gather targets


@pytest.mark.parametrize("rule", WORKING, ids=lambda rule: rule.name)
def test_directives_come_in_the_same_order(rule: Rule) -> None:
    found = list(rule.directives)
    assert found == [directive for directive in DIRECTIVES if directive in found]
    assert {"output", "log", "conda"} < set(found)
    assert len({"script", "shell"} & set(found)) == 1  # and so there is no `run`


@pytest.mark.parametrize("rule", WORKING, ids=lambda rule: rule.name)
def test_rule_and_script_share_a_name(rule: Rule) -> None:
    assert rule.script in {f"workflow/scripts/{rule.name}.py", ""}


def test_every_script_and_page_is_one_of_a_rule() -> None:
    scripts = {path.name for path in (ROOT / "workflow" / "scripts").iterdir() if path.is_file()}
    assert scripts == {Path(rule.script).name for rule in WORKING if rule.script}
    pages = (ROOT / "workflow" / "rules" / "pages.smk").read_text(encoding="utf-8")
    listed = pages.partition("PAGE_TABLES = {")[2].partition("\n}\n")[0]
    named = set(re.findall(r'^    "([\w-]+)": \{', listed, re.MULTILINE))
    assert named == {path.stem for path in (ROOT / "workflow" / "pages").glob("*.md")}


@pytest.mark.parametrize("rule", WORKING, ids=lambda rule: rule.name)
def test_rule_log_and_benchmark_share_a_name(rule: Rule) -> None:
    for directive, ending in (("log", "log"), ("benchmark", "tsv")):
        if directive in rule.directives:
            assert re.search(rf"/{rule.name}(_[^/]*|\{{mode\}})?\.{ending}\"", rule.directives[directive])


@pytest.mark.parametrize("rule", WORKING, ids=lambda rule: rule.name)
def test_rule_that_reads_a_device_depends_on_its_recordings(rule: Rule) -> None:
    named = re.findall(r"^ *(\w+)=", rule.directives.get("input", ""), re.MULTILINE)
    assert bool({"device", "devices"} & set(named)) == ("recordings" in named)


@pytest.mark.parametrize("path", sorted((ROOT / "workflow" / "scripts").glob("*.py")), ids=lambda path: path.stem)
def test_scripts_write_no_table_and_copy_no_figure_in_place(path: Path) -> None:
    """Tables are written by the library, whole or not at all; one rule copies figures."""
    text = path.read_text(encoding="utf-8")
    assert "to_csv" not in text
    assert "copyfile" not in text


def test_lint_finds_nothing(project: Project) -> None:
    run = project.snakemake("--lint")
    assert run.status == 0, run.text
    assert "Congratulations" in run.text


# What a job loads


@functools.cache
def loaded(project: Project, program: str) -> frozenset[str]:
    """All modules that are loaded once a script's or notebook's imports are done, in a process of its own."""
    path = project.folder / program
    if path.suffix == ".ipynb":
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
        code = "\n".join(re.findall(r"^(?:import|from) (?:.*\([^)]*\)|.*)", code, re.MULTILINE))
    else:
        code = f"import runpy; runpy.run_path({str(path)!r}, run_name='loaded')"
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        env=project.environment() | {"PYTHONPATH": str(project.folder / "src")},
        capture_output=True,
        text=True,
        check=True,
    )
    return frozenset(done.stdout.split())


def reaches(project: Project, job: Job, module: str) -> bool:
    """Whether a job loads a module of the package: by its script, or by the notebook that it executes."""
    script = RULES[job.rule].script
    notebooks = [name for name in job.inputs if name.endswith(".ipynb")]
    return any(f"fingerpad.{module}" in loaded(project, name) for name in [script, *notebooks] if name)


@pytest.mark.parametrize("name", sorted(SOLVER))
def test_solver_jobs_load_no_plots_no_tables_no_schemas(project: Project, name: str) -> None:
    assert not {"matplotlib", "pandas", "jsonschema"} & loaded(project, RULES[name].script)


@pytest.mark.parametrize("script", ["filter", "score", "figure_map", "figure_receptors"])
def test_jobs_that_read_solutions_load_no_solver(project: Project, script: str) -> None:
    assert "fingerpad.contact.active_set" not in loaded(project, f"workflow/scripts/{script}.py")


@pytest.mark.parametrize("script", ["solve", "filter", "score"])
def test_jobs_of_every_condition_load_no_scipy(project: Project, script: str) -> None:
    assert not {"scipy", "numpy.f2py"} & loaded(project, f"workflow/scripts/{script}.py")


@pytest.mark.parametrize("script", ["check", "notebook", "report"])
def test_jobs_compile_no_grammar_of_web_addresses(project: Project, script: str) -> None:
    assert "rfc3987_syntax" not in loaded(project, f"workflow/scripts/{script}.py")


# What is planned


@pytest.fixture(scope="module")
def nothing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder without results."""
    return tmp_path_factory.mktemp("nothing")


@pytest.fixture
def fresh(project: Project, tmp_path: Path) -> Project:
    """A copy of the project without results, for a test that changes it."""
    return Project(shutil.copytree(project.folder, tmp_path / "fresh"))


@pytest.fixture(scope="module")
def plan(project: Project, nothing: Path) -> Run:
    """The dry run of everything, from nothing."""
    run = project.snakemake("-n", "all", "--directory", nothing)
    assert run.status == 0, run.text
    return run


def shown(jobs: Iterable[Job]) -> list[str]:
    """Jobs in a form whose differences can be read."""
    return sorted(f"{job.rule}: {', '.join(sorted(job.outputs))}" for job in jobs)


def downstream(jobs: Iterable[Job], starts: Callable[[Job], bool]) -> set[Job]:
    """The jobs at which a change starts, and all that need what those make."""
    rest = set(jobs)
    stale = {job for job in rest if starts(job)}
    while more := {job for job in rest - stale if any(job.inputs & other.outputs for other in stale)}:
        stale |= more
    return stale


def test_every_output_can_be_a_target(project: Project, plan: Run, nothing: Path) -> None:
    run = project.snakemake("-n", *sorted(plan.outputs), "--directory", nothing)
    assert run.status == 0, run.text
    assert shown(run.jobs) == shown(job for job in plan.jobs if job.rule != "all")


def test_every_rule_is_planned_by_a_target(project: Project, nothing: Path, both_scenes: Path) -> None:
    targets = set(project.snakemake("--list-target-rules").text.splitlines()) & set(RULES) - {"all"}
    assert targets >= TABLES
    run = project.snakemake("-n", "all", *sorted(targets), "--directory", nothing, "--config", f"scenes={both_scenes}")
    assert run.status == 0, run.text
    planned = {job.rule for job in run.jobs}
    assert targets <= planned
    assert set(RULES) - planned <= {"condense_body"}  # Device 2 is rigid


def test_one_rule_copies_all_figures_that_pages_show(project: Project, nothing: Path, both_scenes: Path) -> None:
    run = project.snakemake("-n", "docs", "pages", "--directory", nothing, "--config", f"scenes={both_scenes}")
    assert run.status == 0, run.text
    copies = {output: job.rule for job in run.jobs for output in job.outputs if output.startswith("docs/figures/")}
    assert set(copies.values()) == {"shown_figure"}
    assert copies.keys() == {f"docs/figures/{path.name}" for path in (ROOT / "docs" / "figures").iterdir()}


def test_graph_is_timed_on_all_that_a_run_needs(fresh: Project) -> None:
    left = fresh.folder / "workflow/scripts/__pycache__/mesh.pyc"
    left.parent.mkdir()
    left.touch()
    (job,) = fresh.snakemake("-n", "results/benchmark/graph.csv").jobs
    assert job.inputs >= {"Snakefile", "environment.yml", "profiles/default/config.yaml", CONFIG, DEVICE}
    assert job.inputs >= {"data/ratings.csv", "notebooks/walkthrough.ipynb", "workflow/schemas/device.schema.yaml"}
    assert not any("__pycache__" in name for name in job.inputs)


def test_hidden_files_are_left_out(fresh: Project) -> None:
    """As some systems and editors leave them beside what they copy or open."""
    for name in ("config/devices/._device2.yaml", "workflow/rules/custom/._own.smk"):
        (fresh.folder / name).parent.mkdir(exist_ok=True)
        (fresh.folder / name).write_bytes(b"\0 no text")
    run = fresh.snakemake("-n", "results/scores.csv")
    assert run.status == 0, run.text


def test_jobs_have_as_many_threads_as_their_rule_says(fresh: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the user's environment says."""
    custom = fresh.folder / "workflow/rules/custom"
    custom.mkdir()
    (custom / "threads.smk").write_text(THREADS, encoding="utf-8")
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    run = fresh.snakemake("results/one.txt", "results/two.txt")
    assert run.status == 0, run.text
    for name, threads in (("one", "1"), ("two", "2")):
        assert (fresh.folder / f"results/{name}.txt").read_text(encoding="utf-8").strip() == threads


def test_a_scene_file_that_changes_during_a_run_ends_the_jobs_that_read_it(
    project: Project, coarse_scenes: Path, tmp_path: Path
) -> None:
    """Its values are those that the run began with, or nothing is made."""
    copy, scenes = Project(tmp_path / "copy"), tmp_path / "scenes"
    shutil.copytree(project.folder, copy.folder)
    shutil.copytree(coarse_scenes, scenes)
    (copy.folder / "workflow/rules/custom").mkdir()
    (copy.folder / "workflow/rules/custom/edit.smk").write_text(EDIT, encoding="utf-8")
    run = copy.snakemake("results/edited.png", *into(tmp_path / "there", scenes))
    assert run.status == 1
    assert f"{scenes}/devices/device2.yaml: has changed since this run began; run again" in run.text
    assert not (tmp_path / "there/results/edited.png").exists()


# What reruns


@pytest.fixture(scope="module")
def recorded(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The project with both kinematics and what long targets make: empty files that Snakemake records as made, so that
    plans say what a change reruns.
    """
    made = Project(shutil.copytree(project.folder, tmp_path_factory.mktemp("recorded") / "fingerpad"))
    made.edit(CONFIG, lambda text: text.replace("{value: small", "{value: both", 1))
    run = made.snakemake("-n", *LONG)
    assert run.status == 0, run.text
    for name in run.outputs | set(re.findall(r"^    benchmark: (.*)$", run.text, re.MULTILINE)):
        path = made.folder / name
        folder = path if not path.suffix else path.parent
        folder.mkdir(parents=True, exist_ok=True)
        if path.suffix:
            path.touch()
    run = made.snakemake("--touch", "--forceall", *LONG)
    assert run.status == 0, run.text
    return made


@pytest.fixture
def long(recorded: Project, tmp_path: Path) -> Project:
    """A copy of `recorded`, elsewhere."""
    return Project(shutil.copytree(recorded.folder, tmp_path / "long"))


def rules(run: Run) -> set[str]:
    """The rules of a run's jobs that make something."""
    return {job.rule for job in run.jobs if job.outputs}


def test_long_jobs_do_not_rerun_for_comments_and_sources(long: Project) -> None:
    """Nor because the project was moved."""
    for name in (CONFIG, DEVICE, ENSEMBLE, *(f"workflow/schemas/{each}.schema.yaml" for each in ("config", "device"))):
        long.edit(name, lambda text: f"# a remark\n{text}")
    long.edit(ENSEMBLE, lambda text: text.replace("a flatter and a rounder fingertip", "other fingertips"))
    run = long.snakemake("-n", *LONG)
    assert NOTHING in run.text
    assert "is left out" not in run.text  # of the ensemble


INERTIAL = {"vibrate", "frequency_variants"}  # rules that refuse where inertia matters


@pytest.mark.parametrize(
    ("key", "value", "other", "expected", "spared"),
    [
        pytest.param(
            "span_margin",
            "1.12",
            "1.0",
            {"score", "check", "reference", "vibrate", "ensemble_member", "readouts", "benchmark_ladder"}
            | {"calculix", "calculix_condition"},
            {"mesh", "condense", "condense_body", "solve", "press", "stimulate", "filter", "fields", "closed_forms"},
            id="span_margin",
        ),
        pytest.param("inertia_limit", "0.1", "0.2", INERTIAL, LONG_RULES - INERTIAL, id="inertia_limit"),
        pytest.param(
            "newton_tolerance",
            "1.0e-9",
            "1.0e-8",
            LONG_RULES | {"press", "stimulate"},
            {"figure_stimuli"},
            id="tolerance",
        ),
        pytest.param("ogden_exponent", "9.0", "8.0", {"closed_forms", "calculix", "press"}, {"solve"}, id="ogden"),
    ],
)
def test_edited_value_reruns_the_long_jobs_that_read_it(
    long: Project, key: str, value: str, other: str, expected: set[str], spared: set[str]
) -> None:
    long.edit(CONFIG, lambda text: text.replace(f"{key}: {{value: {value}", f"{key}: {{value: {other}"))
    found = rules(long.snakemake("-n", *LONG))
    assert expected <= found
    assert not spared & found


def test_edited_alternative_reruns_its_own_members(long: Project) -> None:
    long.edit(
        ENSEMBLE, lambda text: text.replace("finger.height, times: [0.9, 1.1]", "finger.height, times: [0.9, 1.2]")
    )
    jobs = [job for job in long.snakemake("-n", "ensemble").jobs if job.rule == "ensemble_member"]
    assert len(jobs) == 4  # two kinematics, two half-cycles
    assert all("/finger_height_times_1_2/" in output for job in jobs for output in job.outputs)


def test_edited_stimulus_reruns_what_varies_it_though_it_moves_no_score_as_it_stands(long: Project) -> None:
    """Groups 0, 1, 2, 1 in place of 0, 1, 2, 3 are the same snapshots at 0, 90 and 180 degrees: cos 270 = cos 90."""
    long.edit(DEVICE, lambda text: text.replace("[0, 1, 0, 1]", "[0, 1, 2, 3]"))
    asked = "all", "ensemble", "scorings"
    assert long.snakemake("--touch", "--forceall", *asked).status == 0
    long.edit(DEVICE, lambda text: text.replace("[0, 1, 2, 3]", "[0, 1, 2, 1]"))
    found = rules(long.snakemake("-n", *asked))
    assert {"phases", "ensemble_member"} <= found
    assert "solve" not in found


def test_new_scores_that_equal_the_old_ones_hide_no_other_phases_in_their_figure(long: Project) -> None:
    long.edit(DEVICE, lambda text: text.replace("[0, 90, 180]", "[0, 60, 180]"))
    for name in ("data/ratings.csv", "data/stated_order.csv"):
        long.edit(name, lambda text: re.sub("(device2.*)alternate_090", r"\1alternate_060", text))
    table, figure = "results/phases.csv", "results/figures/phases.png"
    run = long.snakemake("--touch", table)  # as if the run had been interrupted here
    assert run.status == 0, run.text
    assert table not in long.snakemake("-n", table).outputs
    assert figure in long.snakemake("-n", figure).outputs


def test_notebooks_rerun_for_the_scenes_that_they_read(long: Project) -> None:
    def rerun() -> set[str]:
        jobs = long.snakemake("-n", "notebooks").jobs
        return {Path(output).stem for job in jobs if job.rule == "notebook" for output in job.outputs}

    long.edit(DEVICE, lambda text: text.replace("Device 2: lateral pins", "Device 2"))
    assert rerun() == {"walkthrough", "fields", "ablations"}
    assert long.snakemake("--touch", "--forceall", "notebooks").status == 0
    other = long.folder / "config/devices/device9.yaml"
    shutil.copy(long.folder / DEVICE, other)
    assert "fields" in rerun()
    assert "design_your_own" not in rerun()


def test_value_that_no_device_assumes_any_more_is_left_out_of_the_ensemble(long: Project) -> None:
    """Which says so, and makes its tables anew."""
    long.edit(DEVICE, lambda text: re.sub('(pitch: .*source: ")assumption: ', r"\1our drawing: ", text))
    run = long.snakemake("-n", "ensemble")
    for times in ("0.8", "1.2"):
        assert f"actuators.pitch times {times} is left out: no device here assumes a value actuators.pitch" in run.text
    assert "ensemble_tables" in rules(run)
    assert "ensemble_member" not in rules(run)


def test_pressed_finger_that_equals_the_old_one_hides_no_edited_increments(long: Project) -> None:
    long.edit(CONFIG, lambda text: text.replace("stimulus_increments: {value: 4", "stimulus_increments: {value: 8"))
    pressed, solution = (
        f"results/finite/device2/{name}" for name in ("shear/pressed.npz", "alternate_180/shear/solution.npz")
    )
    run = long.snakemake("--touch", pressed)  # as if the run of everything had been interrupted here
    assert run.status == 0, run.text
    assert pressed not in long.snakemake("-n", pressed).outputs
    assert solution in long.snakemake("-n", solution).outputs


@pytest.mark.parametrize(
    ("name", "old", "new", "made", "follows"),
    [
        pytest.param(
            CONFIG,
            "friction: {value: 0.6",
            "friction: {value: 0.0",
            "results/small/device2/alternate_180/frictionless/solution.npz",
            "results/small/device2/alternate_180/frictionless/score.csv",
            id="friction",
        ),
        pytest.param(
            DEVICE,
            "playback: {value: snapshot",
            "playback: {value: cycle",
            "results/small/device2/alternate_180/shear/solution.npz",
            "results/small/device2/alternate_180/shear/score.csv",
            id="times",
        ),
        pytest.param(
            CONFIG,
            "name: nail_bed",
            "name: matrix",
            "results/small/device2/mesh.npz",
            "results/figures/section.png",
            id="layer",
        ),
    ],
)
def test_what_equals_the_old_hides_nothing_of_what_is_said_of_it(
    long: Project, name: str, old: str, new: str, made: str, follows: str
) -> None:
    """What a score's note warns of, and what the section's figure names: none of it is in the arrays."""
    long.edit(name, lambda text: text.replace(old, new))
    run = long.snakemake("--touch", made)  # as if the run of everything had been interrupted here
    assert run.status == 0, run.text
    assert made not in long.snakemake("-n", made).outputs
    assert follows in long.snakemake("-n", follows).outputs


def test_kinematics_of_one_phased_device_rerun_their_phases(long: Project) -> None:
    """Though another one is still predicted with both."""
    other = long.folder / DEVICE.replace("device2", "device9")
    shutil.copy(long.folder / DEVICE, other)
    assert long.snakemake("--touch", "--forceall", "results/phases.csv").status == 0
    assert NOTHING in long.snakemake("-n", "results/phases.csv").text
    small = 'kinematics: {value: small, unit: "1", source: "assumption: strokes are small"}\n'
    other.write_text(small + other.read_text(encoding="utf-8"), encoding="utf-8")
    assert "phases" in rules(long.snakemake("-n", "results/phases.csv"))


def test_graph_of_rules_follows_kinematics_and_custom_rules(long: Project) -> None:
    graph = "results/rule_graph.csv"
    custom = long.folder / "workflow/rules/custom/none.smk"
    custom.parent.mkdir()
    custom.touch()
    assert {"rule_graph", "code_map"} <= rules(long.snakemake("-n", graph, "docs/map.md"))
    custom.unlink()
    assert NOTHING in long.snakemake("-n", graph).text
    long.edit(CONFIG, lambda text: text.replace("{value: both", "{value: small"))
    assert "rule_graph" in rules(long.snakemake("-n", graph))


def test_second_run_does_nothing(finished: Project) -> None:
    before = finished.files()
    run = finished.snakemake("all")
    assert run.status == 0, run.text
    assert NOTHING in run.text
    assert finished.files() == before


def test_copied_project_reruns_nothing(finished: Project, changeable: Project) -> None:
    assert changeable.folder != finished.folder
    assert NOTHING in changeable.snakemake("-n", "all").text


@pytest.mark.parametrize("folder", ["src", "workflow", "config", "data", "notebooks"])
def test_touched_files_rerun_nothing(changeable: Project, folder: str) -> None:
    for path in (changeable.folder / folder).rglob("*.*"):
        path.touch()
    assert NOTHING in changeable.snakemake("-n", "all").text


@pytest.mark.parametrize(
    ("module", "spared"),
    [
        ("readouts.gabor", {"mesh", "condense", "condense_body", "solve"}),
        ("contact.formulation", {"condense_body"}),  # the mesh is fine where contact puts the edges
        ("perception.correlation", SOLVER),
        ("figures.style", SOLVER | TABLES),
    ],
)
def test_edited_module_reruns_exactly_what_reaches_it(
    project: Project, changeable: Project, plan: Run, module: str, spared: set[str]
) -> None:
    stale = downstream(plan.jobs, lambda job: reaches(project, job, module))
    assert stale
    changeable.edit(f"src/fingerpad/{module.replace('.', '/')}.py", lambda text: f"{text}\n\n_NEUTRAL = None\n")
    run = changeable.snakemake("-n", "all")
    assert shown(run.jobs) == shown(stale)
    assert not spared & {job.rule for job in run.jobs}


def test_relabelled_condition_is_scored_again(changeable: Project) -> None:
    """And nothing is solved again: its stimulus is what it was."""
    name = "config/devices/pushed.yaml"
    path = changeable.folder / name
    path.write_text((changeable.folder / DEVICE).read_text(encoding="utf-8"), encoding="utf-8")
    changeable.edit(name, lambda text: text[: text.index("\nstimulus:")] + PUSHED)
    scored = "results/small/pushed/one/shear/score.csv"
    run = changeable.snakemake(scored)
    assert run.status == 0, run.text
    for label, other in (("dispersion: {value: own", "dispersion: {value: other"), ("value: 30,", "value: 60,")):
        changeable.edit(name, lambda text, label=label, other=other: text.replace(label, other))
        assert rules(changeable.snakemake("-n", scored)) == {"score"}
        run = changeable.snakemake(scored)
        assert run.status == 0, run.text


def test_fewer_random_scenes_are_in_as_many_parts(project: Project, tmp_path: Path) -> None:
    """Planned for 600 and 20, and computed for one of each."""
    where = ("--directory", tmp_path, "--config")
    planned = project.snakemake("-n", "stress", *where, "stress_scenes=600", "stress_scenes_finite=20").outputs
    names = ("small_0", "small_1", "finite_0", "summary")
    assert planned == {f"results/stress/{name}.csv" for name in names}
    run = project.snakemake("stress", *where, "stress_scenes=1", "stress_scenes_finite=1")
    assert run.status == 0, run.text
    summary = pd.read_csv(tmp_path / "results" / "stress" / "summary.csv")
    assert summary.loc[summary["what"] == "all", "scenes"].tolist() == [1, 1]


@dataclass(frozen=True)
class WithPrograms(Project):
    """A project whose users have the programs in a folder alone."""

    programs: Path

    def environment(self) -> dict[str, str]:
        """As that of any project."""
        return super().environment() | {"PATH": str(self.programs)}


def test_installed_calculix_is_used_and_a_table_with_it_is_kept(project: Project, tmp_path: Path) -> None:
    """A table that says "skipped" is made again once there is a ccx; one of its results is not once there is none."""
    table, programs = "results/accuracy/calculix.csv", tmp_path / "programs"
    programs.mkdir()
    for name in ("git", "bash", "sh", "which"):
        if found := shutil.which(name):
            (programs / name).symlink_to(found)
    without = WithPrograms(project.folder, programs)
    where = ("--directory", tmp_path)
    run = without.snakemake(table, *where)
    assert run.status == 0, run.text
    assert "skipped" in (tmp_path / table).read_text(encoding="utf-8")
    assert NOTHING in without.snakemake("-n", table, *where).text
    (programs / "ccx").write_text("#!/bin/sh\n", encoding="utf-8")
    (programs / "ccx").chmod(0o755)
    assert rules(without.snakemake("-n", table, *where)) == {"calculix"}
    (tmp_path / table).write_text("calculix_s\n1.0\n", encoding="utf-8")
    run = without.snakemake("--touch", table, *where)
    assert run.status == 0, run.text
    (programs / "ccx").unlink()
    assert NOTHING in without.snakemake("-n", table, *where).text


def test_pages_on_other_scenes_do_not_take_the_place_of_the_projects(
    project: Project, coarse_scenes: Path, tmp_path: Path
) -> None:
    settings = ("--config", f"scenes={coarse_scenes}")
    for name in ("claims.md", "assumptions.md", "figures/phases.png"):
        refused = project.snakemake("-n", f"docs/{name}", *settings)
        assert refused.status != 0
        assert "docs/ is about config/, and scenes are" in refused.text
        planned = project.snakemake("-n", f"docs/{name}", *into(tmp_path, coarse_scenes))
        assert planned.status == 0, planned.text


def test_long_pages_can_be_asked_for_with_small_kinematics_alone(project: Project) -> None:
    outputs = project.snakemake("-n", "pages").outputs
    assert "docs/figures/ensemble.png" in outputs
    assert "docs/figures/ensemble_finite.png" not in outputs


def test_scores_of_more_increments_and_other_read_outs(project: Project, coarse_scenes: Path, tmp_path: Path) -> None:
    """The rules of `accuracy` and `readouts` that solve scenes, on a coarse mesh."""
    made = "results/accuracy/increments.csv", "results/ablation_readout.csv"
    run = project.snakemake(*made, *into(tmp_path, coarse_scenes))
    assert run.status == 0, run.text
    increments, readouts = (pd.read_csv(tmp_path / name) for name in made)
    assert set(increments["device"]) == set(readouts["device"]) == {"device2"}
    assert increments["times_the_increments"].nunique() == 3
    assert readouts["score"].notna().all()


def test_edited_source_or_comment_reruns_nothing(changeable: Project) -> None:
    changeable.edit(CONFIG, lambda text: "# a remark\n" + text.replace('"paper: sigma"', '"paper: sigma, section 2"'))
    changeable.edit(DEVICE, lambda text: re.sub('source: "[^"]*"', 'source: "assumption: any"', text) + "# a remark\n")
    assert NOTHING in changeable.snakemake("-n", "all").text


def test_edited_filter_reruns_filter_and_what_follows(changeable: Project, plan: Run) -> None:
    changeable.edit(CONFIG, lambda text: text.replace("sigma: {value: 1.12", "sigma: {value: 1.13"))
    run = changeable.snakemake("-n", "all")
    assert shown(run.jobs) == shown(downstream(plan.jobs, lambda job: job.rule in {"filter", "check"}))
    assert not {"mesh", "condense", "condense_body", "solve"} & {job.rule for job in run.jobs}


def test_edited_title_reruns_what_shows_it_alone(changeable: Project) -> None:
    changeable.edit(DEVICE, lambda text: re.sub('title: {value: "[^"]*"', 'title: {value: "Another name"', text))
    rules = {job.rule for job in changeable.snakemake("-n", "all").jobs}
    assert "figure_section" in rules
    assert not rules & {*SOLVER, "filter", "score", "check", "scores"}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("modulus: {value: 0.08,", "modulus: {value: 0.09,"),
        ("contact_margin: {value: 0.5,", "contact_margin: {value: 0.6,"),
    ],
    ids=["tissue", "margin"],
)
def test_new_mesh_that_equals_the_old_one_hides_no_other_edit(changeable: Project, old: str, new: str) -> None:
    """What tissue is made of and how much skin is considered are no part of the mesh."""
    changeable.edit(CONFIG, lambda text: text.replace(old, new))
    mesh, condensed = "results/small/device2/mesh.npz", "results/small/device2/condensed.npz"
    run = changeable.snakemake(mesh)  # as if the run of everything had been interrupted here
    assert run.status == 0, run.text
    assert condensed in changeable.snakemake("-n", condensed).outputs


def test_fourth_device_runs_only_its_own_jobs_and_the_tables(changeable: Project, plan: Run) -> None:
    second = (changeable.folder / DEVICE).read_text(encoding="utf-8")
    fourth = second.replace("pitch: {value: 2.5,", "pitch: {value: 2.4,")
    assert fourth != second
    (changeable.folder / DEVICE.replace("device2", "device4")).write_text(fourth, encoding="utf-8")
    before = changeable.files("results")

    planned = changeable.snakemake("-n", "all").jobs
    own = [job for job in planned if job.device]
    assert {job.device for job in own} == {"device4"}
    expected = shown(job for job in plan.jobs if job.device == "device2")
    assert shown(own) == sorted(line.replace("device2", "device4") for line in expected)
    others = {job.rule for job in planned if not job.device}
    assert TABLES < others <= {job.rule for job in plan.jobs if not job.device}

    run = changeable.snakemake("results/scores.csv")
    assert run.status == 0, run.text
    after = changeable.files("results")
    kept = before.keys() - {"results/scores.csv", "results/logs/scores.log"}
    assert {name: after[name] for name in kept} == {name: before[name] for name in kept}
    rows = (changeable.folder / "results/scores.csv").read_text(encoding="utf-8").splitlines()
    assert sum(",device4," in row for row in rows) == sum(",device2," in row for row in rows) > 0


def test_report_is_one_page_and_the_same_every_time(changeable: Project) -> None:
    page = changeable.folder / "results/report.html"
    made = []
    for _ in range(2):
        run = changeable.snakemake("report")
        assert run.status == 0, run.text
        made.append(page.read_bytes())
        page.unlink()
    assert made[0] == made[1]
    figures = list((changeable.folder / "results/figures").glob("*.png"))
    assert made[0].count(b"data:image/png;base64,") == len(figures)
    assert str(changeable.folder).encode() not in made[0]


# Other folders, and runs that end early


@dataclass(frozen=True)
class Elsewhere:
    """A run of coarse scenes with results in another folder that was killed and then finished."""

    project: Project  # what there is in that folder
    planned: Run
    killed: frozenset[str]  # outputs that were there when it was killed
    resumed: Run
    source_before: dict[str, tuple[int, str]]
    source_after: dict[str, tuple[int, str]]


@pytest.fixture(scope="module")
def elsewhere(project: Project, coarse_scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> Elsewhere:
    """Start everything in another folder, kill it as a power cut would, and go on up to the tables."""
    there = Project(tmp_path_factory.mktemp("elsewhere"))
    where = into(there.folder, coarse_scenes)
    before, planned = project.files(), project.snakemake("-n", "all", *where)
    with (there.folder / "killed.log").open("w", encoding="utf-8") as log:
        process = subprocess.Popen(
            project.command("all", *where),
            cwd=project.folder,
            env=project.environment(),
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        end = time.monotonic() + LONGEST_RUN
        try:
            while len(list(there.folder.glob("results/*/*/*/*/score.csv"))) < 2:
                assert process.poll() is None, (there.folder / "killed.log").read_text(encoding="utf-8")
                assert time.monotonic() < end, "no scores in time"
                time.sleep(0.05)
        finally:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    killed = planned.outputs & there.files("results").keys()
    unlocked = project.snakemake("--unlock", *where)
    assert unlocked.status == 0, unlocked.text
    resumed = project.snakemake("results/correlations.csv", "--rerun-incomplete", *where)
    return Elsewhere(there, planned, killed, resumed, before, project.files())


def test_interrupted_run_goes_on_where_it_stopped(elsewhere: Elsewhere) -> None:
    assert elsewhere.resumed.status == 0, elsewhere.resumed.text
    assert 3 < len(elsewhere.killed) < len(elsewhere.planned.outputs)
    again = elsewhere.killed & elsewhere.resumed.outputs
    assert len(again) <= CORES, again  # those that were being written
    assert elsewhere.killed | elsewhere.resumed.outputs >= {
        output for job in elsewhere.planned.jobs if job.rule in SOLVER for output in job.outputs
    }


def test_interruption_and_folder_leave_no_trace_in_the_tables(
    elsewhere: Elsewhere, undisturbed: dict[str, str]
) -> None:
    found = results(elsewhere.project.folder)
    for table in ("results/scores.csv", "results/correlations.csv"):
        assert found[table] == undisturbed[table]


def test_run_elsewhere_leaves_the_project_alone(elsewhere: Elsewhere) -> None:
    assert elsewhere.source_after == elsewhere.source_before


# Bad input


def assert_refused(project: Project, target: str, *said: str) -> None:
    """A real run must fail, say all this, compute nothing and keep what there is."""
    before = project.files("results")
    run = project.snakemake(target)
    assert run.status != 0
    for words in said:
        assert words in run.text
    assert not run.jobs
    assert project.files("results") == before


def test_unknown_device_is_refused(finished: Project) -> None:
    known = "device1, device2, device3"
    assert_refused(finished, "results/small/devise2/mesh.npz", "'devise2'", known, "did you mean 'device2'?")


def test_unknown_condition_is_refused(finished: Project) -> None:
    known = "alternate_000, alternate_090, alternate_180"
    assert_refused(finished, "results/small/device2/alternate_081/shear/solution.npz", "'alternate_081'", known)


@pytest.mark.parametrize("kind", ["small", "finite"])
def test_random_scenes_of_no_number_are_refused(project: Project, nothing: Path, kind: str) -> None:
    target = f"results/stress/{kind}_many.csv"
    run = project.snakemake("-n", target, "--directory", nothing)
    assert run.status != 0
    assert f"No rule to produce {target}" in run.text
    assert "ValueError" not in run.text


@pytest.mark.parametrize(
    ("file", "change", "said"),
    [
        pytest.param(
            CONFIG,
            lambda text: text.replace("  friction:", "  frction:"),
            ["contact.frction", "an unknown key", "did you mean friction?"],
            id="misspelled",
        ),
        pytest.param(
            CONFIG,
            lambda text: text.replace("sigma: {value: 1.12", "sigma: {value: .nan"),
            ["filter.sigma.value", ".nan", "a finite number"],
            id="nan",
        ),
        pytest.param(DEVICE, lambda text: "", ["found an empty file"], id="empty"),
    ],
)
def test_bad_scene_file_is_refused(
    changeable: Project, file: str, change: Callable[[str], str], said: list[str]
) -> None:
    changeable.edit(file, change)
    assert_refused(changeable, "all", f"{file}: ", *said)


@pytest.mark.parametrize("left_out", [["device1"], ["device2"], ["device3"], ["device1", "device2"]], ids="+".join)
def test_a_shipped_device_may_be_left_out(project: Project, tmp_path: Path, left_out: list[str]) -> None:
    """What data/ says of it is left out, too, and all else is planned as before."""
    smaller = Project(shutil.copytree(project.folder, tmp_path / "smaller"))
    for name in left_out:
        (smaller.folder / f"config/devices/{name}.yaml").unlink()
    run = smaller.snakemake("-n", "all")
    assert run.status == 0, run.text
    assert {job.device for job in run.jobs} == {None, "device1", "device2", "device3"} - set(left_out)
    rules = {job.rule for job in run.jobs}
    assert "figure_workflow" in rules
    assert "results/notebooks/walkthrough.html" in run.outputs
    assert ("figure_shear" in rules) is ("device2" not in left_out)  # others do not move sideways without friction


def test_other_phases_are_planned_and_comparisons_are_refused(project: Project, tmp_path: Path) -> None:
    """The walkthrough follows the last condition. Nothing but what is about Device 2's alternate_180 wants it."""
    changed = Project(shutil.copytree(project.folder, tmp_path / "changed"))
    changed.edit(DEVICE, lambda text: text.replace("value: [0, 90, 180]", "value: [0, 60, 120]"))
    for table in ("ratings", "stated_order"):  # of the conditions that there were
        changed.edit(f"data/{table}.csv", lambda text: re.sub(r"(?m)^device2,.*\n", "", text))
    for target in ("all", "notebooks"):
        run = changed.snakemake("-n", target)
        assert run.status == 0, run.text
        (page,) = (job for job in run.jobs if "results/notebooks/walkthrough.html" in job.outputs)
        assert "results/small/device2/alternate_120/shear/filtered.npz" in page.inputs
    for target in ("calculix", "benchmark"):
        run = changed.snakemake("-n", target)
        assert run.status != 0
        assert "compared on device2's alternate_180: config/devices has no such condition" in run.text
        assert "KeyError" not in run.text
    (changed.folder / DEVICE).unlink()
    run = changed.snakemake("-n", "calculix")
    assert "compared on device2's alternate_180: config/devices has no such condition" in run.text
    assert "KeyError" not in run.text


def test_a_device_with_shear_alone_has_no_jobs_without(project: Project, tmp_path: Path) -> None:
    """And the figure without and with shear is of another device, or of none; that of the workflow is drawn."""
    changed = Project(shutil.copytree(project.folder, tmp_path / "changed"))
    alone = 'interfaces: {value: shear, unit: "1", source: "assumption: a test"}\n'
    changed.edit(DEVICE, lambda text: f"{text}\n{alone}")
    run = changed.snakemake("-n", "all")
    assert run.status == 0, run.text
    made = [output for job in run.jobs if job.device == "device2" for output in job.outputs]
    assert any("/shear/" in output for output in made)
    assert not any("/frictionless/" in output for output in made)
    rules = {job.rule for job in run.jobs}
    assert "figure_workflow" in rules and "figure_shear" not in rules


def test_maps_of_names_that_run_together_have_files_of_their_own(
    project: Project, both_scenes: Path, tmp_path: Path
) -> None:
    shutil.copytree(both_scenes, tmp_path, dirs_exist_ok=True)
    base = (tmp_path / "devices/device2.yaml").read_text(encoding="utf-8")
    named = {"pins": "wide_alternate", "pins_wide": "alternate", "finite_pins": "wide_finite"}
    for name, dispersion in named.items():
        text = base.replace("    alternate: {value", f"    {dispersion}: {{value")
        (tmp_path / f"devices/{name}.yaml").write_text(text, encoding="utf-8")
    run = project.snakemake("-n", "all", "finite_maps", "--config", f"scenes={tmp_path}")
    assert run.status == 0, run.text
    drawn = {output: job.device for job in run.jobs if job.rule == "figure_map" for output in job.outputs}
    for kinematics in ("small", "finite"):
        for name, dispersion in named.items():
            assert drawn[f"results/figures/map_{kinematics}_{name}-{dispersion}.png"] == name


def test_braces_in_a_title_are_no_wildcards(project: Project, both_scenes: Path, tmp_path: Path) -> None:
    scenes, there = tmp_path / "scenes", tmp_path / "there"
    shutil.copytree(both_scenes, scenes)
    Project(scenes).edit("devices/device2.yaml", lambda text: text.replace('"Device 2: lateral', '"{short} {} lateral'))
    targets = ("all", "frequency", "scorings", "results/rule_graph.csv")
    planned = project.snakemake("-n", *targets, *into(there, scenes))
    assert planned.status == 0, planned.text
    drawn = project.snakemake("results/figures/stimuli.png", *into(there, scenes))
    assert drawn.status == 0, drawn.text


@pytest.mark.parametrize("name", ["draft", "My-Draft"])
def test_a_draft_beside_the_shipped_devices_blocks_no_other_folder(
    project: Project, both_scenes: Path, name: str
) -> None:
    """Shipped devices are read for their ratings alone, whichever scenes are computed."""
    draft = project.folder / f"config/devices/{name}.yaml"
    draft.write_text("title: draft\n", encoding="utf-8")
    try:
        run = project.snakemake("-n", "all", "--config", f"scenes={both_scenes}")
    finally:
        draft.unlink()
    assert run.status == 0, run.text


def test_a_folder_without_devices_is_named(project: Project, tmp_path: Path) -> None:
    (tmp_path / "devices").mkdir()
    shutil.copy(project.folder / "config/config.yaml", tmp_path)
    run = project.snakemake("-n", "all", "--config", f"scenes={tmp_path}")
    assert run.status != 0
    assert f"{tmp_path / 'devices'}: found no device file" in run.text
