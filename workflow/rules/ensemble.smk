# Which statements depend on which assumption: each varied alone, in either half-cycle of the stimuli, with all kinematics.
# Not part of `all`: ask for it with `snakemake ensemble` (a quarter of an hour of one core with small kinematics, one and a half with finite ones).
# REQUIRED INPUTS: config/ensemble.yaml, results/scores.csv, data/.
# OUTPUTS: results/ensemble/{kinematics}/{member}/{half_cycle}/ with scene files and scores,
# results/ensemble_{claims,correlations,scores}.csv, results/figures/ensemble*.{png,pdf}

from dataclasses import replace

ENSEMBLE = BASE / "config" / "ensemble.yaml"
try:
    ALTERNATIVES = read_ensemble(ENSEMBLE)
except FingerpadError as error:
    raise WorkflowError(str(error)) from None
LEFT_OUT = [each for each in ALTERNATIVES if each.part == "devices" and not varied_in(each)]
# what each member varies, whatever the source
MEMBERS = {slug(AS_CONFIGURED): None} | {
    slug(each.name): replace(each, source="") for each in ALTERNATIVES if each not in LEFT_OUT
}


rule ensemble:
    input:
        ensemble_results,


rule ensemble_member:
    input:
        **ALL_SCENE_FILES,
        ensemble=ancient(ENSEMBLE),
        schemas=ancient(SCHEMA_FILES),
    output:
        scenes=directory("results/ensemble/{kinematics}/{member}/{half_cycle}/scenes"),
        scores="results/ensemble/{kinematics}/{member}/{half_cycle}/scores.csv",
    log:
        "results/logs/ensemble/{kinematics}/{member}/{half_cycle}/ensemble_member.log",
    wildcard_constraints:
        member="|".join(MEMBERS),
        half_cycle="|".join(HALF_CYCLES),
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        code=code("ensemble_member.py"),
        scene=lambda w: [scored(name, w.kinematics) for name in DEVICES_WITH[w.kinematics]],
        written=lambda w: as_written(DEVICES_WITH[w.kinematics]),
        varied=lambda w: support.fingerprint(MEMBERS[w.member]),
        varied_in=lambda w: varied_in(MEMBERS[w.member]),
    script:
        "../scripts/ensemble_member.py"


rule ensemble_tables:
    input:
        members=expand(
            "results/ensemble/{kinematics}/{member}/{half_cycle}/scores.csv",
            kinematics=KINEMATICS,
            member=list(MEMBERS),
            half_cycle=HALF_CYCLES,
        ),
        scores="results/scores.csv",
        ratings=DATA / "ratings.csv",
        order=DATA / "stated_order.csv",
        published=DATA / "published_r2.csv",
    output:
        claims="results/ensemble_claims.csv",
        correlations="results/ensemble_correlations.csv",
        table="results/ensemble_scores.csv",
    log:
        "results/logs/ensemble_tables.log",
    conda:
        ENVIRONMENT
    params:
        code=code("ensemble_tables.py"),
        conditions=KNOWN,
    script:
        "../scripts/ensemble_tables.py"


rule figure_ensemble:
    input:
        claims="results/ensemble_claims.csv",
    output:
        png="results/figures/ensemble{mode}.png",
        pdf="results/figures/ensemble{mode}.pdf",
    log:
        "results/logs/figure_ensemble{mode}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figure_ensemble.py"),
        kinematics=mode_of,
    script:
        "../scripts/figure_ensemble.py"
