# fingerpad: two commands on a fresh machine with Python 3.11 or newer, git and make.
#   make reproduce   sets up its own environment and computes everything: snakemake all
#   make test        makes the same environment and runs the tests
PYTHON ?= python3
VENV ?= .venv
CORES ?= all
BIN = $(VENV)/bin

.PHONY: help environment reproduce test lint lock clean

help:  ## Show this help.
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed 's/:[^#]*##/\t/'

environment: $(VENV)/ready  ## Make the environment from the hash-locked requirements.

$(VENV)/ready: requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "fingerpad needs Python 3.11 or newer")'
	$(PYTHON) -m venv --clear $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@

reproduce: environment  ## Compute everything: snakemake all.
	PATH="$(abspath $(BIN)):$$PATH" $(BIN)/snakemake all --cores $(CORES)

test: environment  ## Run all tests.
	PATH="$(abspath $(BIN)):$$PATH" $(BIN)/python -m pytest -rs -n auto --dist loadfile --no-loadscope-reorder

lint: environment  ## Check formats, lint and types.
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	$(BIN)/mypy --disable-error-code name-defined workflow/scripts  # of undefined names, as all but snakemake are, ruff knows
	PATH="$(abspath $(BIN)):$$PATH" $(BIN)/snakemake --lint

lock:  ## Pin all dependencies with their hashes (needs uv).
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-header \
		--no-annotate pyproject.toml --all-extras --output-file requirements.lock

clean:  ## Remove results and the environment.
	rm -rf results .snakemake $(VENV)
