# What becomes of random scenes: each must end in a certified solution or in a named error.
# Not part of `all`: ask for it with `snakemake stress`; `--config stress_scenes=200 stress_scenes_finite=20` takes fewer.
# REQUIRED INPUTS: none.
# OUTPUTS: results/stress/{kinematics}_{chunk}.csv, results/stress/summary.csv

STRESS_SCENES = {
    "small": config.get("stress_scenes", 10000),
    "finite": config.get("stress_scenes_finite", 500),
}
for name, count in zip(("stress_scenes", "stress_scenes_finite"), STRESS_SCENES.values()):
    if type(count) is not int or count < 1:
        raise WorkflowError(f"--config {name}: found {count!r}; allowed: a whole number, 1 or more")
STRESS_CHUNK = {"small": 500, "finite": 50}  # scenes a job; source: some minutes each (measured)
STRESS_CHUNKS = {
    name: [f"results/stress/{name}_{chunk}.csv" for chunk in range(-(-count // STRESS_CHUNK[name]))]
    for name, count in STRESS_SCENES.items()
}


rule stress:
    input:
        "results/stress/summary.csv",


rule stress_scenes:
    output:
        scenes="results/stress/{kinematics}_{chunk}.csv",
    log:
        "results/logs/stress_scenes_{kinematics}_{chunk}.log",
    benchmark:
        "results/benchmarks/stress_scenes_{kinematics}_{chunk}.tsv"
    wildcard_constraints:
        chunk=r"0|[1-9]\d*",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("stress_scenes.py"),
        first=first_of_chunk,
        stop=lambda w: min((int(w.chunk) + 1) * STRESS_CHUNK[w.kinematics], STRESS_SCENES[w.kinematics]),
    script:
        "../scripts/stress_scenes.py"


rule stress_summary:
    input:
        small=STRESS_CHUNKS["small"],
        finite=STRESS_CHUNKS["finite"],
    output:
        table="results/stress/summary.csv",
    log:
        "results/logs/stress_summary.log",
    conda:
        ENVIRONMENT
    params:
        code=code("stress_summary.py"),
    script:
        "../scripts/stress_summary.py"
