"""From a scene to its scores in one process, with errors and caveats."""
