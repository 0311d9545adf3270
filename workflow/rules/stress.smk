# What becomes of random scenes: each must end in a certified solution or in a named error.
# Not part of `all`: ask for it with `snakemake stress`; `--config stress_scenes=200 stress_scenes_finite=20` takes fewer.
# REQUIRED INPUTS: none.
# OUTPUTS: results/stress/scenes_{chunk}.csv, results/stress/finite_{chunk}.csv, results/stress/summary.csv

STRESS_SCENES = {
    "stress_scenes": config.get("stress_scenes", 10000),
    "stress_scenes_finite": config.get("stress_scenes_finite", 500),
}
for name, count in STRESS_SCENES.items():
    if type(count) is not int or count < 1:
        raise WorkflowError(f"--config {name}: found {count!r}; allowed: a whole number, 1 or more")
STRESS_CHUNK = {"stress_scenes": 500, "stress_scenes_finite": 50}  # scenes a job
STRESS_CHUNKS = {name: range(-(-count // STRESS_CHUNK[name])) for name, count in STRESS_SCENES.items()}


rule stress:
    input:
        "results/stress/summary.csv",


rule stress_scenes:
    output:
        scenes="results/stress/scenes_{chunk}.csv",
    log:
        "results/logs/stress_scenes_{chunk}.log",
    benchmark:
        "results/benchmarks/stress_scenes_{chunk}.tsv"
    wildcard_constraints:
        chunk=r"\d+",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("stress_scenes.py"),
        first=lambda w: int(w.chunk) * STRESS_CHUNK["stress_scenes"],
        stop=lambda w: min((int(w.chunk) + 1) * STRESS_CHUNK["stress_scenes"], STRESS_SCENES["stress_scenes"]),
    script:
        "../scripts/stress_scenes.py"


rule stress_finite:
    output:
        scenes="results/stress/finite_{chunk}.csv",
    log:
        "results/logs/stress_finite_{chunk}.log",
    benchmark:
        "results/benchmarks/stress_finite_{chunk}.tsv"
    wildcard_constraints:
        chunk=r"\d+",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("stress_finite.py"),
        first=lambda w: int(w.chunk) * STRESS_CHUNK["stress_scenes_finite"],
        stop=lambda w: min(
            (int(w.chunk) + 1) * STRESS_CHUNK["stress_scenes_finite"], STRESS_SCENES["stress_scenes_finite"]
        ),
    script:
        "../scripts/stress_finite.py"


rule stress_summary:
    input:
        scenes=expand("results/stress/scenes_{chunk}.csv", chunk=STRESS_CHUNKS["stress_scenes"]),
        finite=expand("results/stress/finite_{chunk}.csv", chunk=STRESS_CHUNKS["stress_scenes_finite"]),
    output:
        summary="results/stress/summary.csv",
    log:
        "results/logs/stress_summary.log",
    conda:
        ENVIRONMENT
    params:
        code=code("stress_summary.py"),
    script:
        "../scripts/stress_summary.py"
