# An independent solver on the same scene: CalculiX, and how far fingerpad is from it (docs/calculix.md).
# Not part of `all`: ask for it with `snakemake calculix`, alone on the machine. Without ccx the table says "skipped".
# REQUIRED INPUTS: scene files. OUTPUTS: results/accuracy/calculix.csv, results/calculix/{case}/ (decks and results)

CALCULIX_CASE = {
    "kinematics": "small",
    "law": "linear",
    "indentation": "full",
    "edges": "rounded",
    "friction": "stimulus",
    "coarsening": 4.0,
    "indentation_increments": 8,
    "stimulus_increments": 4,
    "rest_increments": 3,
    "pressure_slope": 500.0,
    "stick_slope": 100.0,
}
CALCULIX_FINITE_CASE = CALCULIX_CASE | {"kinematics": "finite", "law": "neo_hookean", "indentation": 1.4}
CALCULIX_RUBBING_CASE = CALCULIX_FINITE_CASE | {
    "friction": "always",
    "indentation_increments": 20,
    "stimulus_increments": 8,
}


rule calculix:
    input:
        config=CONFIG,
        device=SCENES / "devices" / "device2.yaml",
        recordings=lambda w: RECORDINGS["device2"],
    output:
        table="results/accuracy/calculix.csv",
        decks=directory("results/calculix"),
    log:
        "results/logs/calculix.log",
    conda:
        ENVIRONMENT
    threads: workflow.cores
    resources:
        mem_mb=4000,
        runtime=120,
    params:
        code=code("calculix.py"),
        condition="alternate_180",
        limit=1800,
        cases={
            "base": CALCULIX_CASE,
            "finer_mesh": CALCULIX_CASE | {"coarsening": 2.0},
            "smaller_increments": CALCULIX_CASE | {"indentation_increments": 16, "stimulus_increments": 8},
            "softer_penalties": CALCULIX_CASE | {"pressure_slope": 250.0, "stick_slope": 50.0},
            "sharp": CALCULIX_CASE | {"edges": "sharp", "coarsening": 2.0},
            "rubbing": CALCULIX_CASE | {"friction": "always", "indentation_increments": 20, "stimulus_increments": 8},
            "rubbing_smaller_increments": CALCULIX_CASE
            | {"friction": "always", "indentation_increments": 40, "stimulus_increments": 16},
            "finite_neo_hookean": CALCULIX_FINITE_CASE,
            "finite_finer_mesh": CALCULIX_FINITE_CASE | {"coarsening": 2.0},
            "finite_sharp": CALCULIX_FINITE_CASE | {"edges": "sharp", "coarsening": 2.0},
            "finite_rubbing": CALCULIX_RUBBING_CASE,
            "finite_rubbing_finer_mesh": CALCULIX_RUBBING_CASE | {"coarsening": 2.0},
            "finite_ogden": CALCULIX_FINITE_CASE | {"law": "ogden"},
            # deeper down this law turns tissue inside out
            "finite_green": CALCULIX_FINITE_CASE | {"law": "green", "indentation": 0.8},
        },
    script:
        "../scripts/calculix.py"
