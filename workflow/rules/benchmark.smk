# Run times: of set-up and of a condition in one process, of the whole graph against empty scripts, against error on ladders
# of meshes (beside CalculiX where ccx is installed), with the size of a scene, and with every skip off.
# Not part of `all`: ask for them with `snakemake benchmark`, alone on the machine (half an hour).
# REQUIRED INPUTS: scene files, results/scores.csv, results/small/device2/reference.csv.
# OUTPUTS: results/benchmark/{timings,graph,ladder,growth,exponents,skipping,always}.csv, results/figures/benchmark.{png,pdf}

LADDERS = [each for each in KINEMATICS if COMPARED_DEVICE in DEVICES_WITH[each]]
# what a run needs of the project
COPIED = ["Snakefile", "workflow", "src", "config", "data", "notebooks", "profiles", "environment.yml"]
SKIPPING_FINITE = [path for path in files_with(Kinematics.FINITE) if path.stem == COMPARED_DEVICE]


rule benchmark:
    input:
        "results/benchmark/timings.csv",
        "results/benchmark/graph.csv",
        "results/benchmark/skipping.csv",
        "results/figures/benchmark.png",
        "results/figures/benchmark.pdf",


rule benchmark_steps:
    input:
        **ALL_SCENE_FILES,
        finite=ancient(files_with(Kinematics.FINITE)),
    output:
        timings="results/benchmark/timings.csv",
    log:
        "results/logs/benchmark_steps.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("benchmark_steps.py"),
        scenes=[scored(name, each) for each, name in COMPUTED],
        repeats={"small": 9, "finite": 3},
    script:
        "../scripts/benchmark_steps.py"


rule benchmark_graph:
    input:
        snakefile=BASE / "Snakefile",
        files=support.files_in(BASE / name for name in COPIED),
    output:
        graph="results/benchmark/graph.csv",
    log:
        "results/logs/benchmark_graph.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        kinematics=["small", "both"],
        repeats=3,
    script:
        "../scripts/benchmark_graph.py"


rule benchmark_ladder:
    input:
        **COMPARED_FILES,
        reference=f"results/small/{COMPARED_DEVICE}/reference.csv",
    output:
        table="results/benchmark/ladder.csv",
        decks=directory("results/benchmark/decks"),
    log:
        "results/logs/benchmark_ladder.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("benchmark_ladder.py"),
        scenes=lambda w: [scored(COMPARED_DEVICE, each) for each in LADDERS],
        condition=COMPARED_CONDITION,
        kinematics=LADDERS,
        finest=0.5,
        factors={
            "small": {
                "fingerpad": [6.0, 4.0, 3.0, 2.0, 1.5, 1.25, 1.0, 0.7, 0.5],
                "first_order": [4.0, 3.0, 2.0, 1.5, 1.0, 0.7, 0.5],
                "plain": [6.0, 4.0, 3.0, 2.0],
                "calculix": [8.0, 5.6, 4.0, 2.8, 2.0, 1.4],
            },
            "finite": {"fingerpad": [6.0, 4.0, 2.0, 1.0], "first_order": [], "plain": [], "calculix": [8.0, 4.0, 2.0]},
        },
        cases={"small": CALCULIX_CASE, "finite": CALCULIX_FINITE_CASE},
        limit=1800,
        repeats={"small": 3, "finite": 1},
        compared=with_calculix("results/benchmark/ladder.csv", "CalculiX"),
    script:
        "../scripts/benchmark_ladder.py"


rule benchmark_growth:
    input:
        **COMPARED_FILES,
    output:
        sizes="results/benchmark/growth.csv",
        fits="results/benchmark/exponents.csv",
    log:
        "results/logs/benchmark_growth.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("benchmark_growth.py"),
        scene=lambda w: scored(COMPARED_DEVICE),
        factors=[2.0, 1.4, 1.0, 0.7, 0.5],
        counts=[4, 8, 16, 32, 64],
        repeats=3,
    script:
        "../scripts/benchmark_growth.py"


rule skipping:
    input:
        **ALL_SCENE_FILES,
        finite=ancient(SKIPPING_FINITE),
        scores="results/scores.csv",
    output:
        switches="results/benchmark/skipping.csv",
        always="results/benchmark/always.csv",
    log:
        "results/logs/skipping.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=6000,
        runtime=60,
    params:
        code=code("skipping.py"),
        scenes=[
            *(scored(name) for name in DEVICES),
            *(scored(path.stem, Kinematics.FINITE) for path in SKIPPING_FINITE),
        ],
        repeats={"small": 5, "finite": 2},
    script:
        "../scripts/skipping.py"


rule figure_benchmark:
    input:
        ladder="results/benchmark/ladder.csv",
        sizes="results/benchmark/growth.csv",
        fits="results/benchmark/exponents.csv",
    output:
        png="results/figures/benchmark.png",
        pdf="results/figures/benchmark.pdf",
    log:
        "results/logs/figure_benchmark.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_benchmark.py"),
        case=f"{COMPARED_DEVICE}, {COMPARED_CONDITION}",
    script:
        "../scripts/figure_benchmark.py"
