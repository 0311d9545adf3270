# Scores under other read-outs: measure, side of the interface, wavelength; and how they agree with those as configured.
# Not part of `all`: ask for them with `snakemake readouts`.
# REQUIRED INPUTS: results/small/{device}/mesh.npz, condensed.npz, results/small/{device}/{condition}/{interface}/solution.npz.
# OUTPUTS: results/ablation_readout.csv, results/ablation_agreement.csv


rule readouts:
    input:
        **ALL_SCENE_FILES,
        meshes=expand("results/small/{device}/mesh.npz", device=DEVICES),
        condensed=expand("results/small/{device}/condensed.npz", device=DEVICES),
        solutions=[
            f"results/small/{name}/{SCENE[name].solved_as(condition).name}/{interface}/solution.npz"
            for _, name, condition, interface in predicted([Kinematics.SMALL])
        ],
    output:
        table="results/ablation_readout.csv",
        compared="results/ablation_agreement.csv",
    log:
        "results/logs/readouts.log",
    benchmark:
        "results/benchmarks/readouts.tsv"
    conda:
        ENVIRONMENT
    params:
        code=code("readouts.py"),
        cases=predicted([Kinematics.SMALL]),
        scenes=[scored(name) for name in DEVICES],
    script:
        "../scripts/readouts.py"
