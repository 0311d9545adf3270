# Pages of docs/ that say what was computed or measured. `snakemake docs` asks for SHORT_PAGES; the others need every long
# target: `snakemake pages`.
# REQUIRED INPUTS: results/claims.csv; results of scorings, honesty, accuracy, calculix, stress, benchmark, frequency and ensemble,
# results/scores.csv.
# OUTPUTS: docs/{page}.md

PAGE_TABLES = {  # by page and by what it calls them
    "accuracy": {
        "scores": "results/accuracy/scores.csv",
        "increments": "results/accuracy/increments.csv",
        "closed_forms": "results/accuracy/closed_forms.csv",
        "calculix": "results/accuracy/calculix.csv",
        "calculix_orders": "results/accuracy/calculix_orders.csv",
        "stress": "results/stress/summary.csv",
    },
    "claims": {"claims": "results/claims.csv"},
    "frequency": {
        "frequencies": "results/frequency.csv",
        "variants": "results/frequency_variants.csv",
        "scores": "results/scores.csv",
    },
    "robustness": {
        "claims": "results/ensemble_claims.csv",
        "correlations": "results/ensemble_correlations.csv",
        "scores": "results/ensemble_scores.csv",
    },
    "run-time": {
        "timings": "results/benchmark/timings.csv",
        "ladder": "results/benchmark/ladder.csv",
        "exponents": "results/benchmark/exponents.csv",
        "graph": "results/benchmark/graph.csv",
    },
    "scorings": {
        "scores": "results/scores.csv",
        "others": "results/scorings.csv",
        "correlations": "results/scoring_correlations.csv",
        "claims": "results/scoring_claims.csv",
        "response": "results/filter_response.csv",
        "phases": "results/phases.csv",
        "frictions": "results/frictions.csv",
    },
    "skipping": {"switches": "results/benchmark/skipping.csv", "always": "results/benchmark/always.csv"},
}
SHORT_PAGES = ("claims", "scorings")  # seconds after `all`
PAGE_FIGURES = {
    "accuracy": ["accuracy_closed_forms", "accuracy_closed_forms_finite"],
    "frequency": ["frequency"],
    "robustness": [f"ensemble{mode}" for mode, kinematics in MODES.items() if kinematics in KINEMATICS],
    "run-time": ["benchmark"],
    "scorings": ["phases"],
}


rule pages:
    input:
        expand("docs/{page}.md", page=[name for name in PAGE_TABLES if name not in SHORT_PAGES]),


rule page:
    input:
        pages_elsewhere,
        template=BASE / "workflow" / "pages" / "{page}.md",
        tables=lambda w: PAGE_TABLES[w.page].values(),
        figures=lambda w: [f"docs/figures/{name}.png" for name in PAGE_FIGURES.get(w.page, [])],
    output:
        written="docs/{page}.md",
    log:
        "results/logs/page_{page}.log",
    wildcard_constraints:
        page="|".join(PAGE_TABLES),
    conda:
        ENVIRONMENT
    params:
        code=code("page.py"),
        names=lambda w: list(PAGE_TABLES[w.page]),
    script:
        "../scripts/page.py"
