# Pages and pictures in docs/ that are made from the project itself, and committed.
# Not part of `all`: ask for them with `snakemake docs`.
# REQUIRED INPUTS: scene files, results/figures/figure_5_correlation.png.
# OUTPUTS: docs/assumptions.md, docs/figures/figure_5_correlation.png


rule docs:
    input:
        assumptions="results/docs/assumptions.md",
        figure="results/figures/figure_5_correlation.png",
    output:
        assumptions=BASE / "docs" / "assumptions.md",
        figure=BASE / "docs" / "figures" / "figure_5_correlation.png",
    log:
        "results/logs/docs.log",
    conda:
        ENVIRONMENT
    shell:
        "(cp {input.assumptions:q} {output.assumptions:q} && cp {input.figure:q} {output.figure:q}) 2> {log:q}"


rule assumptions:
    input:
        files=[CONFIG, *DEVICE_FILES],
        code=code("assumptions.py"),
    output:
        listed="results/docs/assumptions.md",
    log:
        "results/logs/assumptions.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/assumptions.py"
