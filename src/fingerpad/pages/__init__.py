"""Pages of docs/ that are made: prose from templates, numbers from tables of results, and a map of the code."""
