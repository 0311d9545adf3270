"""Figures: pure functions from tidy tables and records to a `matplotlib.figure.Figure`. They compute no physics."""
