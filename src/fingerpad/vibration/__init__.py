"""Vibration: tissue that relaxes and creeps, cycles that repeat themselves, and where inertia forbids a prediction."""
