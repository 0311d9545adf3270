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
        code=code("benchmark_steps.py"),
    output:
        timings="results/benchmark/timings.csv",
    log:
        "results/logs/benchmark_steps.log",
    conda:
        ENVIRONMENT
    threads: workflow.cores
    params:
        repeats=5,
    script:
        "../scripts/benchmark_steps.py"


rule benchmark_graph:
    input:
        snakefile=BASE / "Snakefile",
        scripts=sorted((BASE / "workflow").glob("**/*.*")),
        code=sorted(SOURCE.glob("**/*.py")),
    output:
        graph="results/benchmark/graph.csv",
    log:
        "results/logs/benchmark_graph.log",
    conda:
        ENVIRONMENT
    threads: workflow.cores
    params:
        repeats=3,
    script:
        "../scripts/benchmark_graph.py"
