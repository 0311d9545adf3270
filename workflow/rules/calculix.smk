# An independent solver on the same scene: CalculiX, and how far fingerpad is from it (docs/calculix.md).
# Not part of `all`: ask for it with `snakemake calculix`, alone on the machine. Without ccx the table says "skipped".
# REQUIRED INPUTS: scene files. OUTPUTS: results/accuracy/calculix.csv, results/calculix/{case}/ (decks and results)

CALCULIX_CASE = {
    "edges": "rounded",
    "friction": "stimulus",
    "coarsening": 2.0,
    "indentation_increments": 8,
    "stimulus_increments": 4,
    "rest_increments": 3,
    "pressure_slope": 500.0,
    "stick_slope": 100.0,
}


rule calculix:
    input:
        config=CONFIG,
        device=SCENES / "devices" / "device2.yaml",
        code=code("calculix.py"),
    output:
        table="results/accuracy/calculix.csv",
        decks=directory("results/calculix"),
    log:
        "results/logs/calculix.log",
    conda:
        ENVIRONMENT
    threads: workflow.cores
    params:
        condition="alternate_180",
        limit=1800,
        cases={
            "coarse": CALCULIX_CASE | {"coarsening": 4.0},
            "softer": CALCULIX_CASE | {"coarsening": 4.0, "pressure_slope": 250.0, "stick_slope": 50.0},
            "smaller_increments": CALCULIX_CASE | {"coarsening": 4.0, "stimulus_increments": 16},
            "medium": CALCULIX_CASE,
            "sharp": CALCULIX_CASE | {"edges": "sharp", "friction": "never"},
            "friction_always": CALCULIX_CASE | {"friction": "always", "indentation_increments": 20},
        },
    script:
        "../scripts/calculix.py"
