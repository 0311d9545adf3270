"""The report: one page that holds a run's tables, figures, assumptions and provenance, and needs nothing else."""
