# Notebooks, executed on the results and rendered to pages.
# REQUIRED INPUTS: notebooks/{notebook}.ipynb, the results it reads. OUTPUTS: results/notebooks/{notebook}.html


rule notebook:
    input:
        notebook=BASE / "notebooks" / "{notebook}.ipynb",
        results=[
            "results/scores.csv",
            "results/device2/mesh.npz",
            "results/device2/condensed.npz",
            "results/device2/alternate_180/shear/solution.npz",
            "results/device2/alternate_180/shear/filtered.npz",
        ],
        code=code("notebook.py"),
    output:
        page="results/notebooks/{notebook}.html",
    log:
        "results/logs/notebook_{notebook}.log",
    priority: 1
    conda:
        ENVIRONMENT
    script:
        "../scripts/notebook.py"
