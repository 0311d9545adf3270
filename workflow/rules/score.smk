# Roughness scores: of one device, condition and interface, their errors from a coarser mesh, and the tidy table of all.
# REQUIRED INPUTS: edges.csv and resampling.npz in results/{kinematics}/{device}, solution.npz and filtered.npz in results/{kinematics}/{device}/{condition}/{interface}.
# OUTPUTS: score.csv beside it, results/{kinematics}/{device}/check.csv, results/scores.csv


rule score:
    input:
        **SCENE_FILES,
        solution=solution_of,
        filtered="results/{kinematics}/{device}/{condition}/{interface}/filtered.npz",
        resampling="results/{kinematics}/{device}/resampling.npz",
    output:
        score="results/{kinematics}/{device}/{condition}/{interface}/score.csv",
    log:
        "results/logs/{kinematics}/{device}/{condition}/{interface}/score.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("score.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).device.actuators,
            scene_of(w).model.readout.span_margin,
            scene_of(w).model.numerics,
            scene_of(w).model.finger.pad_thickness,
            scene_of(w).model.contact.friction,
            scene_of(w).model.contact.criterion,
            scene_of(w).model.gabor,
            condition_of(w).dispersion,
            condition_of(w).phase_deg,
            condition_of(w).prescribed,
        ),
    script:
        "../scripts/score.py"


rule check:
    input:
        **SCENE_FILES,
        edges="results/{kinematics}/{device}/edges.csv",
        solutions=solutions_of,
        filtered=filtered_of,
    output:
        errors="results/{kinematics}/{device}/check.csv",
    log:
        "results/logs/{kinematics}/{device}/check.log",
    benchmark:
        "results/benchmarks/{kinematics}/{device}/check.tsv"
    priority: 3
    conda:
        ENVIRONMENT
    params:
        code=code("check.py"),
        scene=scored_of,
        cases=cases_of,
    script:
        "../scripts/check.py"


rule scores:
    input:
        **ALL_SCENE_FILES,
        scores=cases("results/{kinematics}/{device}/{condition}/{interface}/score.csv"),
        checks=[f"results/{each}/{name}/check.csv" for each, name in COMPUTED],
    output:
        table="results/scores.csv",
    log:
        "results/logs/scores.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("scores.py"),
    script:
        "../scripts/scores.py"
