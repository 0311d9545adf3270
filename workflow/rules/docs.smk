# Pages and pictures of docs/ that follow from scene files and from `all`: `snakemake docs`. Those that are filled from tables
# are in pages.smk.
# REQUIRED INPUTS: scene files, the code, docs/claims.md, docs/scorings.md, results/figures/figure_5_correlation.png.
# OUTPUTS: docs/assumptions.md, docs/map.md; docs/figures/{figure}.png, also for the pages of pages.smk


rule docs:
    input:
        "docs/assumptions.md",
        "docs/map.md",
        "docs/claims.md",
        "docs/scorings.md",
        "docs/figures/figure_5_correlation.png",


rule assumptions:
    input:
        pages_elsewhere,
        files=[CONFIG, *DEVICE_FILES],
        package=[SOURCE / "fingerpad" / "__init__.py", *sorted((SOURCE / "fingerpad").rglob("*.py"))],
    output:
        listed="docs/assumptions.md",
    log:
        "results/logs/assumptions.log",
    conda:
        ENVIRONMENT
    params:
        code=code("assumptions.py"),
    script:
        "../scripts/assumptions.py"


rule code_map:
    input:
        package=[SOURCE / "fingerpad" / "__init__.py", *sorted((SOURCE / "fingerpad").rglob("*.py"))],
        rules=RULE_FILES,
        scripts=sorted((BASE / "workflow" / "scripts").glob("*.py")),
    output:
        written="docs/map.md",
    log:
        "results/logs/code_map.log",
    conda:
        ENVIRONMENT
    params:
        code=code("code_map.py"),
    script:
        "../scripts/code_map.py"


rule shown_figure:
    input:
        pages_elsewhere,
        figure="results/figures/{figure}.png",
    output:
        figure="docs/figures/{figure}.png",
    log:
        "results/logs/shown_figure_{figure}.log",
    wildcard_constraints:
        figure=r"\w+",
    conda:
        ENVIRONMENT
    shell:
        "cp {input.figure:q} {output.figure:q} 2> {log:q}"
