# With small kinematics: frictional contact path of one device, condition and interface, with its certificate and receptor strains.
# REQUIRED INPUTS: results/small/{device}/condensed.npz, results/bodies/{device}.npz for deformable actuators.
# OUTPUTS: results/small/{device}/{condition}/{interface}/solution.npz


rule solve:
    input:
        **SCENE_FILES,
        condensed="results/small/{device}/condensed.npz",
        body=body_of,
    output:
        solution="results/small/{device}/{condition}/{interface}/solution.npz",
    log:
        "results/logs/small/{device}/{condition}/{interface}/solve.log",
    benchmark:
        "results/benchmarks/small/{device}/{condition}/{interface}/solve.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("solve.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).device.actuators,
            scene_of(w).model.contact,
            scene_of(w).model.numerics,
            scene_of(w).model.skips,
            condition_of(w).prescribed,
        ),
    script:
        "../scripts/solve.py"
