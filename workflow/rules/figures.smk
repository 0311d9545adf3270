# Figures that mirror the paper's, the ablation, the maps and the section; full fields for those that draw them.
# REQUIRED INPUTS: results of solve, filter, score and correlate. OUTPUTS: results/figures/*.{png,pdf}, fields.npz

FIGURES = []


rule fields:
    input:
        config=ancient(CONFIG),
        device=ancient(device_file),
        mesh="results/{device}/mesh.npz",
        solutions=lambda w: [
            f"results/{w.device}/{condition.name}/shear/solution.npz"
            for condition in scene_of(w).device.conditions
            if scene_of(w).device.first_with_stimulus_of(condition.name) is condition
        ],
        code=code("fields.py"),
    output:
        fields="results/{device}/fields.npz",
    log:
        "results/logs/{device}/fields.log",
    benchmark:
        "results/benchmarks/{device}/fields.tsv"
    conda:
        ENVIRONMENT
    script:
        "../scripts/fields.py"
