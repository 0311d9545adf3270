# An independent solver on the same scene: CalculiX, and how far fingerpad is from it (docs/calculix.md).
# And whether it orders the conditions of all devices as fingerpad does.
# Not part of `all`: ask for them with `snakemake calculix`, alone on the machine, and `snakemake calculix_orders`. Without
# ccx the tables say "skipped".
# REQUIRED INPUTS: scene files. OUTPUTS: results/accuracy/{calculix,calculix_orders}.csv, results/calculix/{case}/ (decks and
# results), results/calculix_orders/{kinematics}/{device}/{condition}.csv and a folder of its deck

# settings of `fingerpad.calculix.case.Case`, which has the others: indentation [mm]; source: finer meshes, softer penalties and
# more increments are cases of their own below (docs/calculix.md)
CALCULIX_CASE = {
    "kinematics": "small",
    "indentation": "full",
    "indentation_increments": 8,
    "coarsening": 4.0,
    "fingerpad_coarsening": 4.0,
}
CALCULIX_FINER = {"coarsening": 2.0, "fingerpad_coarsening": 2.0}
# rubbing, fingerpad's own change of strain moves by a tenth from meshes of these sizes to half of them
CALCULIX_RUBBING = {
    "friction_from": "touch",
    "indentation_increments": 20,
    "stimulus_increments": 8,
    "fingerpad_coarsening": 1.0,
}
CALCULIX_FINITE_CASE = CALCULIX_CASE | {"kinematics": "finite", "law": "neo_hookean", "indentation": 1.4}


rule calculix:
    input:
        **COMPARED_FILES,
    output:
        table="results/accuracy/calculix.csv",
        decks=directory("results/calculix"),
    log:
        "results/logs/calculix.log",
    conda:
        ENVIRONMENT
    threads: ALONE
    resources:
        mem_mb=4000,
        runtime=120,
    params:
        code=code("calculix.py"),
        scene=lambda w: scored(COMPARED_DEVICE),
        ogden_exponent=lambda w: SCENE[COMPARED_DEVICE].model.tissue.ogden_exponent,
        condition=COMPARED_CONDITION,
        limit=1800,
        compared=with_calculix("results/accuracy/calculix.csv", "calculix_s"),
        cases={
            "base": CALCULIX_CASE,
            "finer_mesh": CALCULIX_CASE | CALCULIX_FINER,
            "smaller_increments": CALCULIX_CASE | {"indentation_increments": 16, "stimulus_increments": 8},
            "softer_penalties": CALCULIX_CASE | {"pressure_slope": 250.0, "stick_slope": 50.0},
            "sharp": CALCULIX_CASE | CALCULIX_FINER | {"edges": "sharp"},
            "rubbing": CALCULIX_CASE | CALCULIX_RUBBING,
            "rubbing_finer_mesh": CALCULIX_CASE | CALCULIX_RUBBING | {"coarsening": 2.0},
            "rubbing_smaller_increments": CALCULIX_CASE | CALCULIX_RUBBING | {"indentation_increments": 40},
            "rubbing_smallest_increments": CALCULIX_CASE | CALCULIX_RUBBING | {"indentation_increments": 80},
            "finite_neo_hookean": CALCULIX_FINITE_CASE,
            "finite_finer_mesh": CALCULIX_FINITE_CASE | CALCULIX_FINER,
            "finite_sharp": CALCULIX_FINITE_CASE | CALCULIX_FINER | {"edges": "sharp"},
            "finite_rubbing": CALCULIX_FINITE_CASE | CALCULIX_RUBBING,
            "finite_rubbing_finer_mesh": CALCULIX_FINITE_CASE | CALCULIX_RUBBING | {"coarsening": 2.0},
            "finite_rubbing_smaller_increments": CALCULIX_FINITE_CASE
            | CALCULIX_RUBBING
            | {"indentation_increments": 40},
            "finite_ogden": CALCULIX_FINITE_CASE | {"law": "ogden"},
            # deeper down this law turns tissue inside out
            "finite_green": CALCULIX_FINITE_CASE | {"law": "green", "indentation": 0.8},
        },
    script:
        "../scripts/calculix.py"


rule calculix_orders:
    input:
        # with finite kinematics one device alone, as decks then take long
        scores=[
            f"results/calculix_orders/{each}/{name}/{condition.name}.csv"
            for each in KINEMATICS
            for name in DEVICES_WITH[each]
            if each == Kinematics.SMALL or name == COMPARED_DEVICE
            for condition in SCENE[name].device.distinct_conditions
        ],
    output:
        table="results/accuracy/calculix_orders.csv",
    log:
        "results/logs/calculix_orders.log",
    conda:
        ENVIRONMENT
    params:
        code=code("calculix_orders.py"),
    script:
        "../scripts/calculix_orders.py"


rule calculix_condition:
    input:
        **SCENE_FILES,
    output:
        scores="results/calculix_orders/{kinematics}/{device}/{condition}.csv",
        deck=directory("results/calculix_orders/{kinematics}/{device}/{condition}"),
    log:
        "results/logs/{kinematics}/{device}/{condition}/calculix_condition.log",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=60,
    params:
        code=code("calculix_condition.py"),
        scene=scored_of,
        condition=lambda w: condition_of(w).name,
        limit=1800,
        compared=lambda w, output: with_calculix(output.scores, "calculix"),
        case=lambda w: (CALCULIX_FINITE_CASE if w.kinematics == Kinematics.FINITE else CALCULIX_CASE) | CALCULIX_RUBBING,
    script:
        "../scripts/calculix_condition.py"
