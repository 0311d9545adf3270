# Run times: of set-up and of a condition in one process, and of the whole graph against empty scripts.
# Not part of `all`: ask for them with `snakemake benchmark`, alone on the machine.
# REQUIRED INPUTS: scene files. OUTPUTS: results/benchmark/timings.csv, results/benchmark/graph.csv


rule benchmark:
    input:
        "results/benchmark/timings.csv",
        "results/benchmark/graph.csv",


rule benchmark_steps:
    input:
        config=CONFIG,
        devices=[SCENES / "devices" / f"{name}.yaml" for name in DEVICES],
        code=code("benchmark.py"),
    output:
        timings="results/benchmark/timings.csv",
    params:
        repeats=5,
    log:
        "results/logs/benchmark_steps.log",
    threads: workflow.cores
    conda:
        ENVIRONMENT
    script:
        "../scripts/benchmark.py"


rule benchmark_graph:
    input:
        scripts=sorted((BASE / "workflow").glob("**/*.*")),
        code=sorted(SOURCE.glob("**/*.py")),
    output:
        graph="results/benchmark/graph.csv",
    params:
        base=str(BASE),
        repeats=3,
    log:
        "results/logs/benchmark_graph.log",
    threads: workflow.cores
    conda:
        ENVIRONMENT
    script:
        "../scripts/benchmark_graph.py"
