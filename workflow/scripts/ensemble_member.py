"""Scene files and scores of one member of the ensemble over assumptions."""

from pathlib import Path

from fingerpad.ensemble.alternatives import named_alternative, read_ensemble, write_scenes
from fingerpad.ensemble.members import member_scores
from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.validation import check_device
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.store import write_rows


def main(
    config: Path,
    devices: list[Path],
    ensemble: Path,
    schemas: list[Path],
    member: str,
    half_cycle: str,
    kinematics: Kinematics,
    scenes: Path,
    scores: Path,
) -> None:
    """Write the member's scene files, check them, solve all their conditions, write the scores."""
    alternative = named_alternative(read_ensemble(ensemble), member)
    documents = {path.stem: read_yaml(path) for path in devices}
    own_config, own_devices = write_scenes(scenes, read_yaml(config), documents, alternative, half_cycle)
    found = [check_device(path, schemas[0].parent, own_config) for path in own_devices]
    write_rows(scores, member_scores(found, kinematics, alternative, half_cycle))


if __name__ == "__main__":
    run(main, snakemake)
