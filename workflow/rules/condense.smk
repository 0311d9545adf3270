# What every condition of a device shares with small kinematics: compliance of contact nodes and strain map of receptors;
# and with any, the compliance of its actuators' bodies.
# REQUIRED INPUTS: results/small/{device}/mesh.npz. OUTPUTS: results/small/{device}/condensed.npz, results/bodies/{device}.npz


rule condense:
    input:
        **SCENE_FILES,
        mesh="results/small/{device}/mesh.npz",
    output:
        condensed="results/small/{device}/condensed.npz",
    log:
        "results/logs/small/{device}/condense.log",
    benchmark:
        "results/benchmarks/small/{device}/condense.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("condense.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).model.finger,
            receptors_of(w),
            scene_of(w).model.numerics.contact_margin,
            scene_of(w).model.skips.halved_condensation,
            scene_of(w).device.actuators,
            scene_of(w).device.stroke,
        ),
    script:
        "../scripts/condense.py"


rule condense_body:
    input:
        **SCENE_FILES,
    output:
        body="results/bodies/{device}.npz",
    log:
        "results/logs/{device}/condense_body.log",
    benchmark:
        "results/benchmarks/{device}/condense_body.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("condense_body.py"),
        scene=lambda w: support.fingerprint(scene_of(w).device.actuators, scene_of(w).model.numerics),
    script:
        "../scripts/condense_body.py"
