"""Execute a notebook in the folder of the results and render it to a page."""

import os
import tempfile
from pathlib import Path

from fingerpad.files import write_text
from fingerpad.imports import without
from fingerpad.jobs import run

with without("rfc3987_syntax"):  # a checker of web addresses, which notebooks here have none of; it takes seconds
    import nbformat
    from nbclient import NotebookClient
    from nbconvert import HTMLExporter

# of a page that needs nothing else: without scripts for formulas and diagrams, which notebooks here have none of; on
# paper nothing can be scrolled to
TEMPLATE = """\
{% extends "lab/index.html.j2" %}
{% block html_head_css %}
<style>@media print { .jp-InputArea pre { white-space: pre-wrap; overflow-wrap: anywhere } }</style>
{% endblock %}
{% block html_head_js %}{% endblock %}
{% block html_head_js_mathjax %}{% endblock %}
{% block html_head_js_mermaidjs %}{% endblock %}
"""


def main(notebook: Path, config: Path, page: Path) -> None:
    """Read the notebook, run all of its cells here, write the page; a failing cell fails the job. The
    folder of the scene files is SCENES in the notebook's environment.
    """
    os.environ["SCENES"] = str(config.parent.resolve())
    document = nbformat.read(notebook, as_version=4)
    folder = {"metadata": {"path": str(Path.cwd())}}
    # a page has no kernel, so widgets on it could not move: their state is left out, and what would be loaded for it
    client = NotebookClient(document, record_timing=False, store_widget_state=False, resources=folder)
    # or the kernel warns, in the middle of a run, that others on this machine could listen
    client.create_kernel_manager().transport_encryption = "auto"
    client.execute()
    exporter = HTMLExporter(raw_template=TEMPLATE, exclude_input_prompt=True, exclude_output_prompt=True)
    document.metadata["title"] = document.cells[0].source.splitlines()[0].removeprefix("# ")
    text, _ = exporter.from_notebook_node(document)
    write_text(page, text)


if __name__ == "__main__":
    # jobs run beside each other, and IPython keeps a database there
    with tempfile.TemporaryDirectory() as folder:
        os.environ["IPYTHONDIR"] = folder
        run(main, snakemake)
