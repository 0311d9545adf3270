"""Finite kinematics: tissue that deforms much, and contact on a linearisation of it."""
