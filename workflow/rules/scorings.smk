# What scores owe to the filter, to the sign of a change, to rectifying, to the pre-indented state and to the drive alone: other
# scores of what `all` has solved, of the phases between, and with other friction. Not part of `all`: ask for them with `snakemake scorings`.
# REQUIRED INPUTS: results/{kinematics}/{device}/{condition}/{interface}/filtered.npz, results/scores.csv, data/, scene files.
# OUTPUTS: results/scorings.csv, results/scoring_{correlations,claims}.csv, results/filter_response.csv, results/phases.csv,
# results/frictions.csv, results/figures/phases.{png,pdf}

# what friction of zero means is a question where displacements are known without it
SLIPPERY = [
    name for name in DEVICES_WITH[Kinematics.SMALL] if Interface.FRICTIONLESS in SCENE[name].device.interfaces()
]
PHASED = [name for name in DEVICES if "phases" in device_documents()[name]["stimulus"]]


rule scorings:
    input:
        "results/scorings.csv",
        "results/frictions.csv",
        ["results/figures/phases.png", "results/figures/phases.pdf"] if PHASED else [],


rule other_scores:
    input:
        **ALL_SCENE_FILES,
        filtered=cases("results/{kinematics}/{device}/{condition}/{interface}/filtered.npz"),
        scores="results/scores.csv",
        ratings=DATA / "ratings.csv",
        order=DATA / "stated_order.csv",
        published=DATA / "published_r2.csv",
    output:
        scorings="results/scorings.csv",
        correlations="results/scoring_correlations.csv",
        claims="results/scoring_claims.csv",
        response="results/filter_response.csv",
    log:
        "results/logs/other_scores.log",
    conda:
        ENVIRONMENT
    params:
        code=code("other_scores.py"),
        cases=predicted(),
        conditions=KNOWN,
        scenes=[scored(name, each) for each, name in COMPUTED],
    script:
        "../scripts/other_scores.py"


rule phases:
    input:
        config=ancient(CONFIG),
        devices=ancient([file_of(name) for name in PHASED]),
        recordings=ancient([path for name in PHASED for path in RECORDINGS[name]]),
        schemas=ancient(SCHEMA_FILES),
    output:
        table="results/phases.csv",
    log:
        "results/logs/phases.log",
    benchmark:
        "results/benchmarks/phases.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code("phases.py"),
        scenes=[scored(name, each) for each, name in COMPUTED if name in PHASED],
        written=as_written(PHASED),
    script:
        "../scripts/phases.py"


rule frictions:
    input:
        config=ancient(CONFIG),
        devices=ancient([file_of(name) for name in SLIPPERY]),
        recordings=ancient([path for name in SLIPPERY for path in RECORDINGS[name]]),
    output:
        table="results/frictions.csv",
    log:
        "results/logs/frictions.log",
    benchmark:
        "results/benchmarks/frictions.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code("frictions.py"),
        scenes=[scored(name) for name in SLIPPERY],
    script:
        "../scripts/frictions.py"


rule figure_phases:
    input:
        config=ancient(CONFIG),
        devices=ancient([file_of(name) for name in PHASED]),
        recordings=ancient([path for name in PHASED for path in RECORDINGS[name]]),
        table="results/phases.csv",
    output:
        png="results/figures/phases.png",
        pdf="results/figures/phases.pdf",
    log:
        "results/logs/figure_phases.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_phases.py"),
        scene=lambda w: support.fingerprint([SCENE[name].device for name in PHASED]),
    script:
        "../scripts/figure_phases.py"
