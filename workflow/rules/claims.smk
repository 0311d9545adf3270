# Which of the paper's statements the computed tables support.
# REQUIRED INPUTS: results/scores.csv, results/correlations.csv. OUTPUTS: results/claims.csv


rule claims:
    input:
        scores="results/scores.csv",
        correlations="results/correlations.csv",
    output:
        claims="results/claims.csv",
    log:
        "results/logs/claims.log",
    conda:
        ENVIRONMENT
    params:
        code=code("claims.py"),
    script:
        "../scripts/claims.py"
