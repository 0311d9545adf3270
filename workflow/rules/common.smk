# What all rules share: the validated scenes, the targets that follow from them, and how inputs are named.
# `--config scenes=FOLDER` takes config.yaml and devices/ from another folder than config/.

from contextlib import suppress
from functools import cache

from fingerpad.calculix.program import installed
from fingerpad.scene.contact_law import Interface
from fingerpad.ensemble.alternatives import AS_CONFIGURED, HALF_CYCLES, assumed_by_none, assuming, read_ensemble, slug
from fingerpad.errors import FingerpadError
from fingerpad.guess import closest, hint
from fingerpad.perception.ratings import read_published, read_ratings, read_stated_order
from fingerpad.scene.example import COMPARED, compares_interfaces, example_condition, example_device
from fingerpad.scene.scenefile import build_model, plain_values, recordings
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.device_names import known_devices
from fingerpad.scene.validation import check_config, check_device
from fingerpad.unchanged import begun, remember
from fingerpad.words import MODE_ENDING
from snakemake.exceptions import WorkflowError
from snakemake.logging import logger

SETTINGS = ("scenes", "stress_scenes", "stress_scenes_finite")  # what --config takes
if unknown := [name for name in config if name not in SETTINGS]:
    raise WorkflowError(f"--config: found {', '.join(unknown)}; allowed: {', '.join(SETTINGS)}")

# Snakemake takes text that looks like a number, a truth or nothing for one
if not isinstance(config.get("scenes", ""), str):
    raise WorkflowError(
        f"--config scenes: found {config['scenes']!r}; allowed: a folder; write scenes=./NAME for such a name"
    )
SCENES = Path(config.get("scenes", BASE / "config"))
for folder in (SCENES, BASE):
    if set("{}") & set(str(folder)):  # in names of inputs they are a wildcard's
        raise WorkflowError(f"{folder}: found braces; allowed: a folder without them, here and above")
CONFIG = SCENES / "config.yaml"
RULES = BASE / "workflow" / "rules"
CUSTOM_RULES = sorted((RULES / "custom").glob("[!.]*.smk"))  # of devices that need their own (docs/extending.md)
RULE_FILES = [*sorted(RULES.glob("[!.]*.smk")), *CUSTOM_RULES]
SCHEMAS = BASE / "workflow" / "schemas"
SCHEMA_FILES = [SCHEMAS / f"{name}.schema.yaml" for name in ("config", "device")]
DATA = BASE / "data"
SHIPPED_DEVICES = BASE / "config" / "devices"
ENVIRONMENT = PROJECT / "environment.yml"  # a relative name would be looked for beside the rules

COMPARED_DEVICE, COMPARED_CONDITION = COMPARED  # what comparisons with CalculiX and of run times are about


def file_of(name):
    """The scene file of a device."""
    return SCENES / "devices" / f"{name}.yaml"


try:
    check_config(CONFIG, SCHEMAS)
    if not (DEVICES := known_devices(SCENES / "devices")):
        raise FingerpadError(
            f"{SCENES / 'devices'}: found no device file; `fingerpad new NAME --from device2` begins one"
        )
    DEVICE_FILES = [file_of(name) for name in DEVICES]
    as_begun = begun([CONFIG, *DEVICE_FILES])
    SCENE = {path.stem: check_device(path, SCHEMAS, CONFIG) for path in DEVICE_FILES}
    RECORDINGS = {path.stem: recordings(path) for path in DEVICE_FILES}  # measured displacements, by device
    # what may be rated: the devices that are computed, and the shipped ones, whose ratings are in data/
    SHIPPED = {}
    for path in sorted(set(SHIPPED_DEVICES.glob("[!.]*.yaml")) - set(DEVICE_FILES)):
        with suppress(FingerpadError):  # a draft there concerns no other folder of scenes
            SHIPPED[path.stem] = check_device(path, SCHEMAS, BASE / "config" / "config.yaml")
    # a device of the paper that has no file any more has no conditions: what data/ says of it is left out
    KNOWN = {name: [] for name in sorted(set(read_published(DATA / "published_r2.csv")["device"]))} | {
        name: [condition.name for condition in scene.device.conditions] for name, scene in (SHIPPED | SCENE).items()
    }
    read_ratings(DATA / "ratings.csv", KNOWN)
    read_stated_order(DATA / "stated_order.csv", KNOWN)
except FingerpadError as error:
    raise WorkflowError(str(error)) from None


ALL_RECORDINGS = [path for name in DEVICES for path in RECORDINGS[name]]
if workflow.is_main_process:  # jobs on other machines read these rules anew
    remember({**as_begun, **begun(ALL_RECORDINGS)})
DEVICES_WITH = {
    str(each): [name for name in DEVICES if each in SCENE[name].computed] for each in Kinematics
}  # names of the devices that are predicted with those kinematics
KINEMATICS = [each for each, names in DEVICES_WITH.items() if names]
COMPUTED = [(each, name) for each in KINEMATICS for name in DEVICES_WITH[each]]
MODES = {ending: str(each) for each, ending in MODE_ENDING.items()}  # kinematics by the ending of figures' names
ALONE = workflow.cores  # threads of jobs that measure times: all, so that nothing runs beside them
TARGETS = []  # what `all` makes besides; files in rules/custom add to it


def scene_of(wildcards):
    """The scene of the wildcard device; an unknown one is an error that names the known ones, and so are kinematics or an
    interface with which it is not predicted.
    """
    if wildcards.device not in SCENE:
        meant = hint(closest(wildcards.device, DEVICES), "'")
        raise WorkflowError(f"unknown device {wildcards.device!r}: known are {', '.join(DEVICES)}{meant}")
    scene = SCENE[wildcards.device]
    for name, predicted in (("kinematics", scene.computed), ("interface", scene.device.interfaces())):
        if (asked := wildcards.get(name, predicted[0])) not in predicted:
            raise WorkflowError(
                f"{wildcards.device}: found {name} {asked!r}; it is predicted with {', '.join(predicted)} alone"
            )
    return scene


def condition_of(wildcards):
    """The condition of the wildcards; an unknown one is an error that names the known ones."""
    device = scene_of(wildcards).device
    try:
        return device.condition(wildcards.condition)
    except FingerpadError as error:
        raise WorkflowError(str(error)) from None


def device_file(wildcards):
    """The scene file of the wildcard device."""
    return file_of(scene_of(wildcards).device.name)


def compared_file(wildcards):
    """The scene file of the device that CalculiX and run times are about; without its condition that is an error."""
    if COMPARED not in {(each, own.name) for each in DEVICES for own in SCENE[each].device.conditions}:
        raise WorkflowError(
            f"CalculiX and run times are compared on {COMPARED_DEVICE}'s {COMPARED_CONDITION}: {SCENES / 'devices'} has no such"
            " condition"
        )
    return file_of(COMPARED_DEVICE)


def recordings_of(wildcards):
    """The files with measured displacements that the wildcard device's scene file names, if any."""
    return RECORDINGS[scene_of(wildcards).device.name]


# inputs of jobs that read one scene, of those that read all, and of those that read the one that is compared; `ancient`, as
# a rule's parameters say what it depends on
SCENE_FILES = {
    "config": ancient(CONFIG),
    "device": ancient(device_file),
    "recordings": ancient(recordings_of),
}
ALL_SCENE_FILES = {
    "config": ancient(CONFIG),
    "devices": ancient(DEVICE_FILES),
    "recordings": ancient(ALL_RECORDINGS),
}
COMPARED_FILES = {
    "config": ancient(CONFIG),
    "device": ancient(compared_file),
    "recordings": ancient(lambda wildcards: RECORDINGS[COMPARED_DEVICE]),
}


def files_with(kinematics):
    """The scene files of the devices that are predicted with those kinematics."""
    return [file_of(name) for name in DEVICES_WITH[kinematics]]


def titles_of(names):
    """The titles of some devices by name. As a parameter it stands behind `lambda w:`, as do devices: Snakemake would take
    braces in a title for a wildcard's.
    """
    return {name: SCENE[name].device.title for name in names}


def kinematics_of(wildcards):
    """The wildcard kinematics; without it small."""
    return wildcards.get("kinematics", Kinematics.SMALL)


def mode_of(wildcards):
    """The kinematics that a figure's ending names; those that no device is predicted with are an error."""
    if (kinematics := MODES[wildcards.mode]) not in KINEMATICS:
        raise WorkflowError(
            f"found a figure with {kinematics} kinematics; devices are predicted with {', '.join(KINEMATICS)}"
        )
    return kinematics


def device_with_dispersion(wildcards):
    """The wildcard device; without the wildcard dispersion that is an error."""
    device = scene_of(wildcards).device
    if wildcards.dispersion not in device.by_dispersion:
        known = ", ".join(device.by_dispersion)
        raise WorkflowError(f"{device.name}: found the dispersion {wildcards.dispersion!r}; allowed: {known}")
    return device


def first_of_chunk(wildcards):
    """Number of the first scene of the wildcard chunk; one beyond the last is an error."""
    first = int(wildcards.chunk) * STRESS_CHUNK[wildcards.kinematics]
    if first >= (count := STRESS_SCENES[wildcards.kinematics]):
        raise WorkflowError(
            f"found chunk {wildcards.chunk} of {count} random scenes, {STRESS_CHUNK[wildcards.kinematics]} each"
        )
    return first


def pages_elsewhere(wildcards):
    """Nothing; an error where pages on other scenes would take the place of the project's own."""
    if SCENES.resolve() != (BASE / "config").resolve() and Path.cwd() == BASE.resolve():
        raise WorkflowError(
            f"docs/ is about config/, and scenes are {SCENES}: ask for pages on these with --directory FOLDER"
        )
    return []


def with_calculix(table, sign):
    """Whether CalculiX is installed, or what it computed is in a table that is there, as a sign in its text tells: the table
    is made again once CalculiX can be run, and not where it cannot be any more.
    """
    return installed() or (os.path.exists(table) and sign in Path(table).read_text(encoding="utf-8"))


def scored(name, kinematics=Kinematics.SMALL):
    """What all scores of a device depend on with those kinematics: neither its title nor its vibrations."""
    model, device = SCENE[name].model, SCENE[name].device
    parts = model.finger, model.contact, model.gabor, model.readout, model.numerics, model.skips
    return support.fingerprint(
        *parts, tissue_law(name, kinematics), device.interfaces(), device.actuators, device.conditions
    )


def scored_of(wildcards):
    """`scored` of the wildcard device."""
    return scored(scene_of(wildcards).device.name, kinematics_of(wildcards))


@cache
def device_documents():
    """Device files as they stand: whether a value is an assumption is in its source."""
    return {path.stem: read_yaml(path) for path in DEVICE_FILES}


def as_written(names):
    """What the files of some devices say of actuators and stimulus, but for vibrations: where another value there is varied,
    it can move scores that it does not move as the file stands.
    """
    parts = [plain_values([device_documents()[name][key] for key in ("actuators", "stimulus")]) for name in names]
    return support.fingerprint([[row, stimulus | {"frequency_hz": None}] for row, stimulus in parts])


def varied_in(alternative):
    """The devices in whose files an alternative takes the place of an assumption, if it is one of devices."""
    return assuming(device_documents(), alternative.key) if alternative else []


def ensemble_results(wildcards):
    """What is made when the ensemble is asked for; alternatives that no device here has are told."""
    for each in LEFT_OUT:
        logger.warning(f"{ENSEMBLE}: {each.name} is left out: {assumed_by_none(device_documents(), each.key)}")
    modes = [mode for mode, kinematics in MODES.items() if kinematics in KINEMATICS]
    figures = expand("results/figures/ensemble{mode}.{suffix}", mode=modes, suffix=("png", "pdf"))
    return ["results/ensemble_claims.csv", *figures]


def tissue_law(name, kinematics):
    """What finite kinematics know of the tissue of a device's scene besides its layers; with small ones nothing."""
    tissue = SCENE[name].model.tissue
    return (tissue.law, tissue.ogden_exponent) if kinematics == Kinematics.FINITE else None


def turns(name, kinematics):
    """Whether the contact normal of a device's scene turns where friction acts, with those kinematics."""
    return SCENE[name].model.contact.turns(Kinematics(kinematics), Interface.SHEAR)


def cases_of(wildcards):
    """Conditions and interfaces of the wildcard device."""
    device = scene_of(wildcards).device
    return [(condition.name, str(interface)) for condition in device.conditions for interface in device.interfaces()]


def filtered_of(wildcards):
    """Filtered read-outs of all cases of the wildcard device."""
    folder = f"results/{wildcards.kinematics}/{wildcards.device}"
    return [f"{folder}/{condition}/{interface}/filtered.npz" for condition, interface in cases_of(wildcards)]


def distinct_solutions_of(wildcards):
    """Solutions with shear of the wildcard device's different stimuli."""
    folder = f"results/{wildcards.kinematics}/{wildcards.device}"
    return [f"{folder}/{each.name}/shear/solution.npz" for each in scene_of(wildcards).device.distinct_conditions]


def solutions_of(wildcards):
    """Solutions that hold for all cases of the wildcard device."""
    solved_as = scene_of(wildcards).solved_as
    folder = f"results/{wildcards.kinematics}/{wildcards.device}"
    return [f"{folder}/{solved_as(name).name}/{interface}/solution.npz" for name, interface in cases_of(wildcards)]


def tissue_of(wildcards):
    """`tissue_law` of the wildcard device."""
    return tissue_law(scene_of(wildcards).device.name, kinematics_of(wildcards))


def receptors_of(wildcards):
    """Where the wildcard device's receptors are read."""
    readout = scene_of(wildcards).model.readout
    return readout.layer_above, readout.side


def pressing_of(wildcards):
    """What pressing the wildcard device depends on, and so does every stimulus from there."""
    model, device = scene_of(wildcards).model, scene_of(wildcards).device
    tissue = tissue_law(device.name, Kinematics.FINITE)
    parts = model.finger, tissue, receptors_of(wildcards), model.contact, model.numerics, model.skips
    return *parts, device.actuators, device.stroke


def solution_of(wildcards):
    """The solution that holds for the wildcard condition: equal stimuli are solved once."""
    solved = scene_of(wildcards).solved_as(condition_of(wildcards).name)
    return f"results/{kinematics_of(wildcards)}/{wildcards.device}/{solved.name}/{wildcards.interface}/solution.npz"


def pressed_of(wildcards):
    """With finite kinematics the pressed finger of the wildcard interface; with small ones nothing."""
    finite = kinematics_of(wildcards) == Kinematics.FINITE
    return (
        f"results/finite/{wildcards.device}/{wildcards.get('interface', Interface.SHEAR)}/pressed.npz" if finite else []
    )


def code_of(program):
    """What a script or notebook and the modules that it reaches say: a rule reruns when that changes. As a parameter it is
    compared once; as inputs, Snakemake would look at each module of each waiting job again and again.
    """
    return support.checksum_of_code(program, SOURCE)


def code(script):
    """`code_of` a rule's script."""
    return code_of(BASE / "workflow" / "scripts" / script)


def predicted(kinematics=KINEMATICS):
    """Those kinematics, and every device, condition and interface that can be predicted with them."""
    return [
        (str(each), name, condition.name, str(interface))
        for each in kinematics
        for name in DEVICES_WITH[each]
        for condition in SCENE[name].device.conditions
        for interface in SCENE[name].device.interfaces()
    ]


def cases(pattern, kinematics=KINEMATICS):
    """The pattern for all that is `predicted`, in that order."""
    named = ("kinematics", "device", "condition", "interface")
    return [pattern.format(**dict(zip(named, each, strict=True))) for each in predicted(kinematics)]


def sheared(kinematics):
    """Devices and their conditions with those kinematics."""
    return [(name, condition.name) for name in DEVICES_WITH[kinematics] for condition in SCENE[name].device.conditions]


def body_of(wildcards):
    """The condensed body of a deformable actuator, or nothing."""
    return f"results/bodies/{wildcards.device}.npz" if scene_of(wildcards).device.actuators.body else []


wildcard_constraints:
    kinematics="|".join(Kinematics),
    mode="|".join(MODES),
    device="[a-z][a-z0-9_]*",
    condition="[a-z][a-z0-9_]*",
    interface="|".join(Interface),
