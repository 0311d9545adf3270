# How far the library is off closed forms: contact, partial slip, layers, near incompressibility, orders of convergence.
# Not part of `all`: ask for it with `snakemake accuracy`.
# REQUIRED INPUTS: scene files. OUTPUTS: results/accuracy/closed_forms.csv, results/figures/accuracy_closed_forms.{png,pdf}


rule accuracy:
    input:
        "results/accuracy/closed_forms.csv",
        "results/figures/accuracy_closed_forms.png",
        "results/figures/accuracy_closed_forms.pdf",


rule closed_forms:
    input:
        config=ancient(CONFIG),
        device=ancient(SCENES / "devices" / f"{DEVICES[0]}.yaml"),
        code=code("closed_forms.py"),
    output:
        table="results/accuracy/closed_forms.csv",
    log:
        "results/logs/closed_forms.log",
    benchmark:
        "results/benchmarks/closed_forms.tsv"
    conda:
        ENVIRONMENT
    params:
        scene=support.fingerprint(
            SCENE[DEVICES[0]].model.finger,
            SCENE[DEVICES[0]].model.readout,
            SCENE[DEVICES[0]].model.numerics,
            SCENE[DEVICES[0]].device.actuators,
        ),
    script:
        "../scripts/closed_forms.py"


rule figure_accuracy:
    input:
        table="results/accuracy/closed_forms.csv",
        code=code("figure_accuracy.py"),
    output:
        png="results/figures/accuracy_closed_forms.png",
        pdf="results/figures/accuracy_closed_forms.pdf",
    log:
        "results/logs/figure_accuracy.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/figure_accuracy.py"
