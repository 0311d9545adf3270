# Notebooks, executed on the results and rendered to pages. `all` has the walkthrough; `snakemake notebooks` renders all.
# REQUIRED INPUTS: notebooks/{notebook}.ipynb, the results that it reads. OUTPUTS: results/notebooks/{notebook}.html

# the condition that notebooks look into, which they find by the same function
INTO, CONDITION = (each.name for each in example_condition([SCENE[name].device for name in DEVICES]))
CASE = f"results/small/{INTO}/{CONDITION}/shear"
# What each notebook cannot do without.
READ_BY = {
    "walkthrough": [
        "results/scores.csv",
        f"results/small/{INTO}/mesh.npz",
        f"results/small/{INTO}/condensed.npz",
        f"results/small/{INTO}/{SCENE[INTO].solved_as(CONDITION).name}/shear/solution.npz",
        f"{CASE}/filtered.npz",
    ],
    "fields": [f"{CASE}/fields.vtu", f"{CASE}/states"],
    "design_your_own": [],
    "accuracy_and_run_time": ["results/scores.csv"],
    "ablations": ["results/scores.csv", "results/ablation_readout.csv", "results/ablation_agreement.csv"],
}
# The scenes that each reads. Results are of SCENE; what is designed in a notebook lies on the finger of config/.
SCENES_OF = {
    "walkthrough": SCENE[INTO],
    "fields": list(SCENE.values()),
    "ablations": list(SCENE.values()),
    "design_your_own": build_model(read_yaml(BASE / "config" / "config.yaml")),
}
# What a notebook shows where it has been made. These take hours: as inputs they would be made anew once they are old.
SHOWN_BY = {
    "accuracy_and_run_time": [
        *(f"results/accuracy/{name}.csv" for name in ("scores", "closed_forms")),
        *(f"results/benchmark/{name}.csv" for name in ("timings", "ladder", "growth", "exponents", "graph")),
    ]
}


rule notebooks:
    input:
        expand("results/notebooks/{notebook}.html", notebook=READ_BY),


rule notebook:
    input:
        config=ancient(CONFIG),
        notebook=BASE / "notebooks" / "{notebook}.ipynb",
        results=lambda w: READ_BY[w.notebook],
    output:
        page="results/notebooks/{notebook}.html",
    log:
        "results/logs/notebook_{notebook}.log",
    wildcard_constraints:
        notebook="|".join(READ_BY),
    priority: 1
    conda:
        ENVIRONMENT
    params:
        code=lambda w: [code("notebook.py"), code_of(BASE / "notebooks" / f"{w.notebook}.ipynb")],
        scenes=lambda w: support.fingerprint(SCENES_OF.get(w.notebook)),
        shown=lambda w: support.checksum(filter(os.path.exists, SHOWN_BY.get(w.notebook, []))),
    script:
        "../scripts/notebook.py"
