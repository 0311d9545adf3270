# fingerpad: predicts which stimuli of a distributed haptic device feel rougher. Start with `snakemake all` (see README.md).
import os
import sys
from pathlib import Path

from snakemake.utils import min_version

min_version("9.0")

PROJECT = Path(workflow.basedir)
# inputs' names begin with it: relative, so that a project that is moved is not computed again
BASE = Path() if PROJECT == Path.cwd() else PROJECT
SOURCE = BASE / "src"
sys.path[:0] = [str(PROJECT / "src"), str(PROJECT / "workflow")]
import support

# jobs find the library, whose `fingerpad.jobs.run` gives each one thread, whatever its rule says: so results do not depend
# on the machine's cores, and jobs run beside each other
os.environ |= {"PYTHONPATH": str(PROJECT / "src")}
os.environ.pop("MPLBACKEND", None)  # they show no windows, and matplotlib ends at a name that it does not know


# priorities: 3 for the longest, 2 for what the tables wait for, 1 for what is long or what long jobs wait for; so that no
# core idles at the end
include: "workflow/rules/common.smk"
include: "workflow/rules/mesh.smk"
include: "workflow/rules/condense.smk"
include: "workflow/rules/solve.smk"
include: "workflow/rules/press.smk"
include: "workflow/rules/filter.smk"
include: "workflow/rules/score.smk"
include: "workflow/rules/correlate.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/readouts.smk"
include: "workflow/rules/scorings.smk"
include: "workflow/rules/vtu.smk"
include: "workflow/rules/notebooks.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/docs.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/calculix.smk"
include: "workflow/rules/frequency.smk"
include: "workflow/rules/ensemble.smk"
include: "workflow/rules/benchmark.smk"
include: "workflow/rules/stress.smk"
include: "workflow/rules/pages.smk"


for custom in CUSTOM_RULES:

    include: custom


rule all:
    default_target: True
    input:
        "results/scores.csv",
        "results/correlations.csv",
        "results/claims.csv",
        FIGURES,
        "results/notebooks/walkthrough.html",
        TARGETS,
