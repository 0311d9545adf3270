# Correlation of scores with perceived roughness, for every device, interface and read-out.
# REQUIRED INPUTS: results/scores.csv, data/. OUTPUTS: results/correlations.csv


rule correlate:
    input:
        scores="results/scores.csv",
        ratings=DATA / "ratings.csv",
        order=DATA / "stated_order.csv",
        published=DATA / "published_r2.csv",
    output:
        correlations="results/correlations.csv",
    log:
        "results/logs/correlate.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("correlate.py"),
        conditions=KNOWN,
    script:
        "../scripts/correlate.py"
