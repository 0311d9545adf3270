"""Scores and what people feel: ratings, correlations, and the statements of the paper."""
