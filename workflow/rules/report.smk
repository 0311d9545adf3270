# The report: one self-contained page of a run's tables, figures, assumptions and provenance.
# Not part of `all`: ask for it with `snakemake report`. (Snakemake's own flag `--report` is another thing.)
# REQUIRED INPUTS: tables and figures of `all`. OUTPUTS: results/report.html, results/rule_graph.csv,
# results/figures/rules.{png,pdf}


rule report:
    input:
        config=CONFIG,
        devices=DEVICE_FILES,
        recordings=ALL_RECORDINGS,
        data=[DATA / name for name in ("ratings.csv", "stated_order.csv", "published_r2.csv")],
        scores="results/scores.csv",
        correlations="results/correlations.csv",
        claims="results/claims.csv",
        figures=[figure for figure in FIGURES if figure.endswith(".png")],
        graph="results/rule_graph.csv",
        rules="results/figures/rules.png",
        template=BASE / "workflow" / "report" / "report.html",
        pyproject=BASE / "pyproject.toml",
    output:
        page="results/report.html",
    log:
        "results/logs/report.log",
    conda:
        ENVIRONMENT
    params:
        code=code("report.py"),
        commit=lambda w: support.commit(BASE),
        example=EXAMPLE,
    script:
        "../scripts/report.py"


rule rule_graph:
    input:
        config=ancient(CONFIG),
        snakefile=BASE / "Snakefile",
        rules=RULE_FILES,
        support=BASE / "workflow" / "support.py",
    output:
        graph="results/rule_graph.csv",
    log:
        "results/logs/rule_graph.log",
    conda:
        ENVIRONMENT
    params:
        code=code("rule_graph.py"),
        scene=lambda w: support.fingerprint([SCENE[name].device for name in DEVICES], DEVICES_WITH),
    script:
        "../scripts/rule_graph.py"


rule figure_rules:
    input:
        graph="results/rule_graph.csv",
    output:
        png="results/figures/rules.png",
        pdf="results/figures/rules.pdf",
    log:
        "results/logs/figure_rules.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_rules.py"),
    script:
        "../scripts/figure_rules.py"
