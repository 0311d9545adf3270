# Mesh of the finger's section, graded for one device.
# REQUIRED INPUTS: scene files. OUTPUTS: results/{device}/mesh.npz


rule mesh:
    input:
        config=ancient(CONFIG),
        device=ancient(device_file),
        recordings=ancient(recordings_of),
        code=code("mesh.py"),
    output:
        mesh="results/{device}/mesh.npz",
    log:
        "results/logs/{device}/mesh.log",
    benchmark:
        "results/benchmarks/{device}/mesh.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        scene=lambda w: support.fingerprint(
            scene_of(w).model.finger,
            scene_of(w).model.readout.layer_above,
            scene_of(w).model.contact,
            scene_of(w).model.numerics,
            scene_of(w).device.control,
            scene_of(w).device.actuators,
            [support.path_of(condition) for condition in scene_of(w).device.conditions],
        ),
    script:
        "../scripts/mesh.py"
