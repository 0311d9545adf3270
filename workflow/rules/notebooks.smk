# Notebooks, executed on the results and rendered to pages. `all` has the walkthrough; `snakemake notebooks` renders all.
# REQUIRED INPUTS: notebooks/{notebook}.ipynb, the results that it reads. OUTPUTS: results/notebooks/{notebook}.html

CASE = "results/small/device2/alternate_180/shear"  # the condition that notebooks look into
# What each notebook cannot do without. Tables of accuracy and run time take long: that page shows those there are.
READ_BY = {
    "walkthrough": [
        "results/scores.csv",
        "results/small/device2/mesh.npz",
        "results/small/device2/condensed.npz",
        f"{CASE}/solution.npz",
        f"{CASE}/filtered.npz",
    ],
    "fields": [f"{CASE}/fields.vtu", f"{CASE}/states"],
    "design_your_own": [],
    "accuracy_and_run_time": ["results/scores.csv"],
    "ablations": ["results/scores.csv", "results/ablation_readout.csv", "results/ablation_agreement.csv"],
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
        # results are of SCENE; what notebooks design themselves begins with the shipped device
        scene=support.fingerprint(SCENE.get("device2"), SHIPPED.get("device2")),
    script:
        "../scripts/notebook.py"
