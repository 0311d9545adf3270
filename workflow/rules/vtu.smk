# Full fields of a condition for ParaView: displacement, strain, stress, layer, contact tractions.
# fields.vtu is the end of the stimulus; fields.pvd is the path there: pre-indented and at each time of the stimulus.
# Not part of `all`: ask for one file, or for all of small kinematics with `snakemake vtu` (of each condition and interface 8 MB for the pre-indented state, each time, and the end).
# REQUIRED INPUTS: results/{kinematics}/{device}/mesh.npz, results/{kinematics}/{device}/{condition}/{interface}/solution.npz;
# with finite kinematics results/finite/{device}/{interface}/pressed.npz, and results/bodies/{device}.npz for deformable actuators.
# OUTPUTS: fields.vtu, fields.pvd and states/ beside the solution


rule vtu:
    input:
        cases("results/{kinematics}/{device}/{condition}/{interface}/fields.vtu", [Kinematics.SMALL]),


rule field_output:
    input:
        **SCENE_FILES,
        mesh="results/{kinematics}/{device}/mesh.npz",
        body=body_of,
        pressed=pressed_of,
        solution=solution_of,
    output:
        vtu="results/{kinematics}/{device}/{condition}/{interface}/fields.vtu",
        pvd="results/{kinematics}/{device}/{condition}/{interface}/fields.pvd",
        states=directory("results/{kinematics}/{device}/{condition}/{interface}/states"),
    log:
        "results/logs/{kinematics}/{device}/{condition}/{interface}/field_output.log",
    benchmark:
        "results/benchmarks/{kinematics}/{device}/{condition}/{interface}/field_output.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
    params:
        code=code("field_output.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).model.finger,
            tissue_of(w),
            scene_of(w).device.actuators,
            scene_of(w).device.stroke,
            condition_of(w).time,
        ),
    script:
        "../scripts/field_output.py"
