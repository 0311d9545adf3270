"""Frictional contact on condensed tissue: states, increments, paths, pre-indentation, and a solved condition."""
