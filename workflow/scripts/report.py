"""Put tables, figures, assumptions and provenance of a run on one page."""

from pathlib import Path

from fingerpad.files import write_text
from fingerpad.jobs import run
from fingerpad.report.captions import Results, rules_words
from fingerpad.report.page import Picture, data_uri, pictures_of, report
from fingerpad.report.provenance import provenance
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.sources import quantities
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.store import read_rows


def main(
    config: Path,
    devices: list[Path],
    scores: Path,
    correlations: Path,
    claims: Path,
    recordings: list[Path],
    data: list[Path],
    figures: list[Path],
    graph: Path,
    rules: Path,
    template: Path,
    pyproject: Path,
    commit: str,
    example: str,
    page: Path,
) -> None:
    """Read everything, fill the template, write the page."""
    scenes = tuple(load_scene(config, path) for path in devices)
    results = Results(scenes, tuple(read_rows(scores)), tuple(read_rows(correlations)), example)
    write_text(
        page,
        report(
            template.read_text(encoding="utf-8"),
            results,
            read_rows(claims),
            quantities(read_yaml(config)),
            {path.stem: quantities(read_yaml(path)) for path in devices},
            pictures_of(figures, results),
            Picture("rules", rules_words(read_rows(graph)), data_uri(rules)),
            provenance(pyproject, commit, [config, *devices, *recordings, *data, scores, correlations, claims]),
        ),
    )


if __name__ == "__main__":
    run(main, snakemake)
