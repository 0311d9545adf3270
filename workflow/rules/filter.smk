# Gabor-filtered read-outs of one device, condition and interface. Equal stimuli share one solution.
# REQUIRED INPUTS: results/{device}/{condition}/{interface}/solution.npz. OUTPUTS: filtered.npz beside it


rule filter:
    input:
        config=ancient(CONFIG),
        device=ancient(device_file),
        solution=lambda w: (
            f"results/{w.device}/{scene_of(w).device.first_with_stimulus_of(condition_of(w).name).name}"
            f"/{w.interface}/solution.npz"
        ),
        code=code("filter.py"),
    output:
        filtered="results/{device}/{condition}/{interface}/filtered.npz",
    params:
        scene=lambda w: support.fingerprint(scene_of(w).model.gabor),
    log:
        "results/logs/{device}/{condition}/{interface}/filter.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/filter.py"
