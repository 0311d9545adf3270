"""Closed forms, and what the library's own mesh, condensation and contact make of them."""
