# Scores of the devices that name a frequency_hz as vibrations, at each frequency; on tissue that creeps, small kinematics.
# Not part of `all`: ask for them with `snakemake frequency` (minutes).
# REQUIRED INPUTS: results/small/{device}/mesh.npz, condensed.npz and resampling.npz beside it, results/bodies/{device}.npz for deformable actuators.
# OUTPUTS: results/small/{device}/frequency.csv, frequency_variants.csv beside it, both of all devices in
# results, results/figures/frequency.{png,pdf}

VIBRATING = [name for name in DEVICES if SCENE[name].device.frequencies]
VARIED_AT = 40.0  # Hz: where other assumptions on how tissue relaxes are tried; source: within what all devices list


rule frequency:
    input:
        "results/frequency.csv",
        ["results/figures/frequency.png", "results/figures/frequency.pdf"] if VIBRATING else [],


rule vibrate:
    input:
        **SCENE_FILES,
        mesh="results/small/{device}/mesh.npz",
        condensed="results/small/{device}/condensed.npz",
        body=body_of,
        resampling="results/small/{device}/resampling.npz",
    output:
        scores="results/small/{device}/frequency.csv",
    log:
        "results/logs/small/{device}/vibrate.log",
    benchmark:
        "results/benchmarks/small/{device}/vibrate.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code("vibrate.py"),
        scene=scored_of,
        vibration=lambda w: support.fingerprint(
            scene_of(w).model.vibration, scene_of(w).device.cycles, scene_of(w).device.frequencies
        ),
    script:
        "../scripts/vibrate.py"


rule frequency_variants:
    input:
        **SCENE_FILES,
        mesh="results/small/{device}/mesh.npz",
        condensed="results/small/{device}/condensed.npz",
        body=body_of,
        resampling="results/small/{device}/resampling.npz",
    output:
        table="results/small/{device}/frequency_variants.csv",
    log:
        "results/logs/small/{device}/frequency_variants.log",
    benchmark:
        "results/benchmarks/small/{device}/frequency_variants.tsv"
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code("frequency_variants.py"),
        scene=scored_of,
        vibration=lambda w: support.fingerprint(scene_of(w).model.vibration, scene_of(w).device.cycles),
        frequency=VARIED_AT,
    script:
        "../scripts/frequency_variants.py"


rule frequencies:
    input:
        scores=expand("results/small/{device}/frequency.csv", device=VIBRATING),
        varied=expand("results/small/{device}/frequency_variants.csv", device=VIBRATING),
    output:
        table="results/frequency.csv",
        variants="results/frequency_variants.csv",
    log:
        "results/logs/frequencies.log",
    conda:
        ENVIRONMENT
    params:
        code=code("frequencies.py"),
    script:
        "../scripts/frequencies.py"


rule figure_frequency:
    input:
        config=ancient(CONFIG),
        devices=ancient([file_of(name) for name in VIBRATING]),
        recordings=ancient([path for name in VIBRATING for path in RECORDINGS[name]]),
        table="results/frequency.csv",
    output:
        png="results/figures/frequency.png",
        pdf="results/figures/frequency.pdf",
    log:
        "results/logs/figure_frequency.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_frequency.py"),
        titles=lambda w: titles_of(VIBRATING),
    script:
        "../scripts/figure_frequency.py"
