# Pages of docs/ that say what was measured. They need every long target; not part of `all`: `snakemake pages`.
# REQUIRED INPUTS: results of honesty, accuracy, calculix, stress, benchmark, frequency and ensemble, results/scores.csv.
# OUTPUTS: docs/accuracy.md, docs/skipping.md, docs/frequency.md, docs/robustness.md


rule pages:
    input:
        "docs/accuracy.md",
        "docs/skipping.md",
        "docs/frequency.md",
        "docs/robustness.md",


rule accuracy_page:
    input:
        template=BASE / "workflow" / "pages" / "accuracy.md",
        scores="results/accuracy/scores.csv",
        increments="results/accuracy/increments.csv",
        closed_forms="results/accuracy/closed_forms.csv",
        calculix="results/accuracy/calculix.csv",
        stress="results/stress/summary.csv",
        timings="results/benchmark/timings.csv",
        ladder="results/benchmark/ladder.csv",
        exponents="results/benchmark/exponents.csv",
        graph="results/benchmark/graph.csv",
        figures=expand(
            "docs/figures/{name}.png", name=["accuracy_closed_forms", "accuracy_closed_forms_finite", "benchmark"]
        ),
    output:
        page="docs/accuracy.md",
    log:
        "results/logs/accuracy_page.log",
    conda:
        ENVIRONMENT
    params:
        code=code("accuracy_page.py"),
    script:
        "../scripts/accuracy_page.py"


rule skipping_page:
    input:
        template=BASE / "workflow" / "pages" / "skipping.md",
        switches="results/benchmark/skipping.csv",
        always="results/benchmark/always.csv",
    output:
        page="docs/skipping.md",
    log:
        "results/logs/skipping_page.log",
    conda:
        ENVIRONMENT
    params:
        code=code("skipping_page.py"),
    script:
        "../scripts/skipping_page.py"


rule frequency_page:
    input:
        template=BASE / "workflow" / "pages" / "frequency.md",
        table="results/frequency.csv",
        variants="results/frequency_variants.csv",
        scores="results/scores.csv",
        figure="docs/figures/frequency.png",
    output:
        page="docs/frequency.md",
    log:
        "results/logs/frequency_page.log",
    conda:
        ENVIRONMENT
    params:
        code=code("frequency_page.py"),
    script:
        "../scripts/frequency_page.py"


rule robustness_page:
    input:
        template=BASE / "workflow" / "pages" / "robustness.md",
        claims="results/ensemble_claims.csv",
        correlations="results/ensemble_correlations.csv",
        figure="docs/figures/ensemble.png",
    output:
        page="docs/robustness.md",
    log:
        "results/logs/robustness_page.log",
    conda:
        ENVIRONMENT
    params:
        code=code("robustness_page.py"),
    script:
        "../scripts/robustness_page.py"
