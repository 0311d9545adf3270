# Figures that mirror the paper's, the ablation, the maps and the section; full fields for those that draw them.
# REQUIRED INPUTS: results of solve, filter, score and correlate. OUTPUTS: results/figures/*.{png,pdf}, fields.npz

DISPERSIONS = {name: sorted({condition.dispersion for condition in SCENE[name].device.conditions}) for name in DEVICES}
SLIDING = [name for name in DEVICES if compares_interfaces(SCENE[name].device)]  # what figure 6 can show
EXAMPLE = example_device([SCENE[name].device for name in DEVICES]).name  # what figures 3 and 6 show
# of each kinematics, with the devices that it shows
SHOWN = {
    "figure_4_receptors": DEVICES,
    "figure_5_correlation": DEVICES,
    "figure_6_shear": [EXAMPLE] if SLIDING else [],
    "ablation_shear": DEVICES,
}
FIGURES = [
    f"results/figures/{stem}.{suffix}"
    for stem in (
        "figure_3_workflow",
        *(
            f"{stem}{mode}"
            for stem, names in SHOWN.items()
            for mode, kinematics in MODES.items()
            if set(names) & set(DEVICES_WITH[kinematics])
        ),
        *(["kinematics"] if Kinematics.FINITE in KINEMATICS else []),
        "section",
        "stimuli",
        *(f"map_small_{name}-{dispersion}" for name in DEVICES for dispersion in DISPERSIONS[name]),
    )
    for suffix in ("png", "pdf")
]


rule finite_maps:
    input:
        expand(
            "results/figures/map_finite_{map}.{suffix}",
            map=[f"{name}-{each}" for name in DEVICES_WITH[Kinematics.FINITE] for each in DISPERSIONS[name]],
            suffix=["png", "pdf"],
        ),


rule fields:
    input:
        **SCENE_FILES,
        mesh="results/{kinematics}/{device}/mesh.npz",
        body=body_of,
        pressed=pressed_of,
        solutions=distinct_solutions_of,
    output:
        fields="results/{kinematics}/{device}/fields.npz",
    log:
        "results/logs/{kinematics}/{device}/fields.log",
    benchmark:
        "results/benchmarks/{kinematics}/{device}/fields.tsv"
    priority: 1
    conda:
        ENVIRONMENT
    params:
        code=code("fields.py"),
        scene=lambda w: support.fingerprint(
            scene_of(w).model.finger, scene_of(w).device.actuators, scene_of(w).device.stroke, tissue_of(w)
        ),
    script:
        "../scripts/fields.py"


rule figure_receptors:
    input:
        config=ancient(CONFIG),
        devices=ancient(lambda w: files_with(mode_of(w))),
        recordings=ancient(ALL_RECORDINGS),
        condensed=lambda w: [f"results/small/{name}/condensed.npz" for name in DEVICES_WITH[mode_of(w)]],
        solutions=lambda w: [
            f"results/{mode_of(w)}/{name}/{SCENE[name].device.conditions[0].name}/shear/solution.npz"
            for name in DEVICES_WITH[mode_of(w)]
        ],
        filtered=lambda w: [
            f"results/{mode_of(w)}/{name}/{condition}/shear/filtered.npz" for name, condition in sheared(mode_of(w))
        ],
    output:
        png="results/figures/figure_4_receptors{mode}.png",
        pdf="results/figures/figure_4_receptors{mode}.pdf",
    log:
        "results/logs/figure_receptors{mode}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_receptors.py"),
        cases=lambda w: sheared(mode_of(w)),
        kinematics=mode_of,
        scene=lambda w: support.fingerprint([SCENE[name].device for name in DEVICES_WITH[mode_of(w)]]),
    script:
        "../scripts/figure_receptors.py"


rule figure_correlation:
    input:
        scores="results/scores.csv",
        ratings=DATA / "ratings.csv",
        correlations="results/correlations.csv",
    output:
        png="results/figures/figure_5_correlation{mode}.png",
        pdf="results/figures/figure_5_correlation{mode}.pdf",
    log:
        "results/logs/figure_correlation{mode}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_correlation.py"),
        kinematics=mode_of,
        titles=lambda w: titles_of(DEVICES_WITH[mode_of(w)]),
        conditions=KNOWN,
    script:
        "../scripts/figure_correlation.py"


rule figure_ablation:
    input:
        scores="results/scores.csv",
        correlations="results/correlations.csv",
    output:
        png="results/figures/ablation_shear{mode}.png",
        pdf="results/figures/ablation_shear{mode}.pdf",
    log:
        "results/logs/figure_ablation{mode}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_ablation.py"),
        kinematics=mode_of,
        turning=lambda w: any(turns(name, mode_of(w)) for name in DEVICES_WITH[mode_of(w)]),
        titles=lambda w: titles_of(DEVICES_WITH[mode_of(w)]),
    script:
        "../scripts/figure_ablation.py"


rule figure_kinematics:
    input:
        scores="results/scores.csv",
        curves="results/indentation.csv",
    output:
        png="results/figures/kinematics.png",
        pdf="results/figures/kinematics.pdf",
    log:
        "results/logs/figure_kinematics.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_kinematics.py"),
        titles=lambda w: titles_of(DEVICES),
    script:
        "../scripts/figure_kinematics.py"


rule figure_section:
    input:
        **ALL_SCENE_FILES,
        mesh=f"results/small/{DEVICES[0]}/mesh.npz",
    output:
        png="results/figures/section.png",
        pdf="results/figures/section.pdf",
    log:
        "results/logs/figure_section.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_section.py"),
        scene=lambda w: support.fingerprint(
            SCENE[DEVICES[0]].model.finger,
            SCENE[DEVICES[0]].model.readout,
            [SCENE[name].device for name in DEVICES],
        ),
    script:
        "../scripts/figure_section.py"


rule figure_stimuli:
    input:
        **ALL_SCENE_FILES,
    output:
        png="results/figures/stimuli.png",
        pdf="results/figures/stimuli.pdf",
    log:
        "results/logs/figure_stimuli.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_stimuli.py"),
        scene=lambda w: support.fingerprint([SCENE[name].device for name in DEVICES]),
    script:
        "../scripts/figure_stimuli.py"


rule figure_map:
    input:
        **SCENE_FILES,
        fields=lambda w: f"results/{w.kinematics}/{device_with_dispersion(w).name}/fields.npz",
        solutions=distinct_solutions_of,
    output:
        png="results/figures/map_{kinematics}_{device}-{dispersion}.png",
        pdf="results/figures/map_{kinematics}_{device}-{dispersion}.pdf",
    log:
        "results/logs/figure_map_{kinematics}_{device}-{dispersion}.log",
    wildcard_constraints:
        dispersion="|".join(sorted({dispersion for names in DISPERSIONS.values() for dispersion in names})),
    conda:
        ENVIRONMENT
    params:
        code=code("figure_map.py"),
        scene=lambda w: support.fingerprint(scene_of(w).device),
    script:
        "../scripts/figure_map.py"


rule figure_workflow:
    input:
        config=ancient(CONFIG),
        device=ancient(file_of(EXAMPLE)),
        recordings=ancient(RECORDINGS[EXAMPLE]),
        condensed=f"results/small/{EXAMPLE}/condensed.npz",
        solution=f"results/small/{EXAMPLE}/{SCENE[EXAMPLE].device.conditions[0].name}/shear/solution.npz",
        filtered=[
            f"results/small/{EXAMPLE}/{condition.name}/shear/filtered.npz"
            for condition in SCENE[EXAMPLE].device.conditions
        ],
        scores="results/scores.csv",
    output:
        png="results/figures/figure_3_workflow.png",
        pdf="results/figures/figure_3_workflow.pdf",
    log:
        "results/logs/figure_workflow.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_workflow.py"),
        scene=lambda w: support.fingerprint(
            SCENE[EXAMPLE].device, SCENE[EXAMPLE].model.gabor, SCENE[EXAMPLE].model.readout
        ),
    script:
        "../scripts/figure_workflow.py"


if SLIDING:

    rule figure_shear:
        input:
            scores="results/scores.csv",
            ratings=DATA / "ratings.csv",
            correlations="results/correlations.csv",
        output:
            png="results/figures/figure_6_shear{mode}.png",
            pdf="results/figures/figure_6_shear{mode}.pdf",
        log:
            "results/logs/figure_shear{mode}.log",
        conda:
            ENVIRONMENT
        params:
            code=code("figure_shear.py"),
            kinematics=mode_of,
            turning=lambda w: turns(EXAMPLE, mode_of(w)),
            device=EXAMPLE,
            title=lambda w: SCENE[EXAMPLE].device.title,
            conditions=KNOWN,
        script:
            "../scripts/figure_shear.py"
