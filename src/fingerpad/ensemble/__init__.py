"""An ensemble over assumptions: scenes with one of them varied, and what then becomes of the statements."""
