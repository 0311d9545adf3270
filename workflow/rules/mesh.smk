# Mesh of the finger's section, graded for one device, and the resampling of its receptors to a uniform grid.
# REQUIRED INPUTS: scene files. OUTPUTS: edges.csv, mesh.npz and resampling.npz in results/{kinematics}/{device}/


rule mesh:
    input:
        **SCENE_FILES,
    output:
        edges="results/{kinematics}/{device}/edges.csv",
        mesh="results/{kinematics}/{device}/mesh.npz",
        resampling="results/{kinematics}/{device}/resampling.npz",
    log:
        "results/logs/{kinematics}/{device}/mesh.log",
    benchmark:
        "results/benchmarks/{kinematics}/{device}/mesh.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("mesh.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).model.finger,
            tissue_of(w),
            receptors_of(w),
            scene_of(w).model.gabor.spacing,
            scene_of(w).model.contact,
            scene_of(w).model.numerics,
            scene_of(w).model.skips,
            scene_of(w).device.interfaces(),
            scene_of(w).device.actuators,
            [condition.prescribed for condition in scene_of(w).device.conditions],
        ),
    script:
        "../scripts/mesh.py"
