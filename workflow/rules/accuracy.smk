# How far the library is off closed forms: contact, partial slip, layers, near incompressibility, orders of convergence.
# And how far scores are off a reference of 20 times the unknowns, and whether their stated errors are honest.
# Not part of `all`: ask for them with `snakemake accuracy` and `snakemake honesty` (two hours of one core and more, 16 GB).
# REQUIRED INPUTS: scene files, results/scores.csv.
# OUTPUTS: results/accuracy/closed_forms.csv, results/figures/accuracy_closed_forms{_finite}.{png,pdf},
# results/accuracy/{increments,scores}.csv, results/{kinematics}/{device}/reference.csv

LAYERED = SCENE[DEVICES[0]]  # the closed forms of layers are on its finger, which all devices have


rule accuracy:
    input:
        "results/accuracy/closed_forms.csv",
        "results/accuracy/increments.csv",
        expand("results/figures/accuracy_closed_forms{mode}.{ending}", mode=MODES, ending=["png", "pdf"]),


rule honesty:
    input:
        scores="results/scores.csv",
        references=[f"results/{each}/{name}/reference.csv" for each, name in COMPUTED],
    output:
        table="results/accuracy/scores.csv",
    log:
        "results/logs/honesty.log",
    conda:
        ENVIRONMENT
    params:
        code=code("honesty.py"),
    script:
        "../scripts/honesty.py"


rule reference:
    input:
        **SCENE_FILES,
    output:
        scores="results/{kinematics}/{device}/reference.csv",
    log:
        "results/logs/{kinematics}/{device}/reference.log",
    benchmark:
        "results/benchmarks/{kinematics}/{device}/reference.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=lambda wildcards: 12000 if wildcards.kinematics == Kinematics.FINITE else 5000,  # measured: 10010, 4440
        runtime=480,
    params:
        code=code("reference.py"),
        scene=scored_of,
    script:
        "../scripts/reference.py"


rule increments:
    input:
        **ALL_SCENE_FILES,
        scores="results/scores.csv",
    output:
        table="results/accuracy/increments.csv",
    log:
        "results/logs/increments.log",
    conda:
        ENVIRONMENT
    params:
        code=code("increments.py"),
        scenes=[scored(name) for name in DEVICES],
        multiples=[2, 4, 16],
    script:
        "../scripts/increments.py"


rule closed_forms:
    input:
        config=ancient(CONFIG),
        device=ancient(file_of(LAYERED.device.name)),
        recordings=ancient(RECORDINGS[LAYERED.device.name]),
    output:
        table="results/accuracy/closed_forms.csv",
    log:
        "results/logs/closed_forms.log",
    benchmark:
        "results/benchmarks/closed_forms.tsv"
    conda:
        ENVIRONMENT
    params:
        code=code("closed_forms.py"),
        scene=support.fingerprint(
            LAYERED.model.finger,
            LAYERED.model.readout.layer_above,
            LAYERED.model.numerics,
            tissue_law(LAYERED.device.name, Kinematics.FINITE),
            LAYERED.device.actuators,
        ),
    script:
        "../scripts/closed_forms.py"


rule figure_accuracy:
    input:
        table="results/accuracy/closed_forms.csv",
    output:
        png="results/figures/accuracy_closed_forms{mode}.png",
        pdf="results/figures/accuracy_closed_forms{mode}.pdf",
    log:
        "results/logs/figure_accuracy_closed_forms{mode}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_accuracy.py"),
        kinematics=lambda w: MODES[w.mode],  # closed forms are of both, whatever the devices
    script:
        "../scripts/figure_accuracy.py"
