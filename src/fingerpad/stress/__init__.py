"""Random scenes, and what becomes of them."""
