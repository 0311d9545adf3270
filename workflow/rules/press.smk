# With finite kinematics: a device pressed onto the finger, and each of its stimuli from there.
# REQUIRED INPUTS: results/finite/{device}/mesh.npz, results/bodies/{device}.npz for deformable actuators.
# OUTPUTS: results/finite/{device}/{interface}/pressed.npz, results/finite/{device}/{condition}/{interface}/solution.npz;
# force against indentation, of small kinematics too: results/indentation.csv


rule press:
    input:
        **SCENE_FILES,
        mesh="results/finite/{device}/mesh.npz",
        body=body_of,
    output:
        pressed="results/finite/{device}/{interface}/pressed.npz",
    log:
        "results/logs/finite/{device}/{interface}/press.log",
    benchmark:
        "results/benchmarks/finite/{device}/{interface}/press.tsv"
    priority: 3
    conda:
        ENVIRONMENT
    params:
        code=code("press.py"),
        scene=lambda w: support.fingerprint(*pressing_of(w)),
    script:
        "../scripts/press.py"


rule stimulate:
    input:
        **SCENE_FILES,
        mesh="results/finite/{device}/mesh.npz",
        body=body_of,
        pressed="results/finite/{device}/{interface}/pressed.npz",
    output:
        solution="results/finite/{device}/{condition}/{interface}/solution.npz",
    log:
        "results/logs/finite/{device}/{condition}/{interface}/stimulate.log",
    benchmark:
        "results/benchmarks/finite/{device}/{condition}/{interface}/stimulate.tsv"
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("stimulate.py"),
        scene=lambda w: support.fingerprint(*pressing_of(w), condition_of(w).prescribed),
    script:
        "../scripts/stimulate.py"


PRESSED = [(name, each) for name in DEVICES_WITH[Kinematics.FINITE] for each in SCENE[name].device.interfaces()]


rule indentation:
    input:
        **ALL_SCENE_FILES,
        condensed=expand("results/small/{device}/condensed.npz", device=DEVICES),
        bodies=[f"results/bodies/{name}.npz" for name in DEVICES if SCENE[name].device.actuators.body],
        pressed=[f"results/finite/{name}/{interface}/pressed.npz" for name, interface in PRESSED],
    output:
        table="results/indentation.csv",
    log:
        "results/logs/indentation.log",
    conda:
        ENVIRONMENT
    params:
        code=code("indentation.py"),
        cases=PRESSED,
        scenes=support.fingerprint(
            [
                (
                    each.model.contact,
                    each.model.numerics,
                    each.model.skips,
                    each.device.actuators,
                    each.device.interfaces(),
                )
                for each in SCENE.values()
            ]
        ),
    script:
        "../scripts/indentation.py"
