# What becomes of random scenes: each must end in a certified solution or in a named error.
# Not part of `all`: ask for it with `snakemake stress`; `--config stress_scenes=200` takes fewer, for a look.
# REQUIRED INPUTS: none. OUTPUTS: results/stress/scenes_{chunk}.csv, results/stress/summary.csv

STRESS_SCENES = config.get("stress_scenes", 10000)
if type(STRESS_SCENES) is not int or STRESS_SCENES < 1:
    raise WorkflowError(f"--config stress_scenes: found {STRESS_SCENES!r}; allowed: a whole number, 1 or more")
STRESS_CHUNK = 500  # scenes a job
STRESS_CHUNKS = range(-(-STRESS_SCENES // STRESS_CHUNK))


rule stress:
    input:
        "results/stress/summary.csv",


rule stress_scenes:
    input:
        code=code("stress_scenes.py"),
    output:
        scenes="results/stress/scenes_{chunk}.csv",
    log:
        "results/logs/stress_scenes_{chunk}.log",
    benchmark:
        "results/benchmarks/stress_scenes_{chunk}.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        first=lambda w: int(w.chunk) * STRESS_CHUNK,
        stop=lambda w: min((int(w.chunk) + 1) * STRESS_CHUNK, STRESS_SCENES),
    script:
        "../scripts/stress_scenes.py"


rule stress_summary:
    input:
        scenes=expand("results/stress/scenes_{chunk}.csv", chunk=STRESS_CHUNKS),
        code=code("stress_summary.py"),
    output:
        summary="results/stress/summary.csv",
    log:
        "results/logs/stress_summary.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/stress_summary.py"
