# Gabor-filtered read-outs of one device, condition and interface. Equal stimuli share one solution.
# REQUIRED INPUTS: results/{kinematics}/{device}/resampling.npz, results/{kinematics}/{device}/{condition}/{interface}/solution.npz.
# OUTPUTS: filtered.npz beside the solution


rule filter:
    input:
        **SCENE_FILES,
        resampling="results/{kinematics}/{device}/resampling.npz",
        solution=solution_of,
    output:
        filtered="results/{kinematics}/{device}/{condition}/{interface}/filtered.npz",
    log:
        "results/logs/{kinematics}/{device}/{condition}/{interface}/filter.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("filter.py"),
        scene=lambda w: support.fingerprint(scene_of(w).model.gabor),
    script:
        "../scripts/filter.py"
