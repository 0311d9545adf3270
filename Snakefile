# fingerpad: predicts how rough a distributed haptic device feels. Start with `snakemake all` (see README.md).
import os
import sys
from pathlib import Path

from snakemake.utils import min_version

min_version("9.0")

BASE = Path(workflow.basedir)
SOURCE = BASE / "src"
sys.path[:0] = [str(SOURCE), str(BASE / "workflow")]
os.environ["PYTHONPATH"] = str(SOURCE)
# one thread a job: results do not depend on the machine's cores, and jobs run beside each other
for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"
# the figures' PDFs carry no time of making
os.environ["SOURCE_DATE_EPOCH"] = "0"


include: "workflow/rules/common.smk"
include: "workflow/rules/mesh.smk"
include: "workflow/rules/condense.smk"
include: "workflow/rules/solve.smk"
include: "workflow/rules/filter.smk"
include: "workflow/rules/score.smk"
include: "workflow/rules/correlate.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/notebooks.smk"
include: "workflow/rules/benchmark.smk"


rule all:
    input:
        "results/scores.csv",
        "results/correlations.csv",
        "results/claims.csv",
        FIGURES,
        "results/notebooks/walkthrough.html",

    default_target: True
