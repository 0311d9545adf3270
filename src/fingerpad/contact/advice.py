"""Errors of contact that say what was being solved, and what else may help."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from ..errors import ContactError, CriterionError, DepthError
from ..scene.contact_law import Criterion, Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics

WHERE = "(in the device file, or in config/config.yaml for every device)"
NARROWER = f"; contact.criterion: depth or force {WHERE} may need less indentation, as a narrower row does"
TOUCH = f"; contact.criterion: touch, depth or force {WHERE} may need less indentation, as a narrower row does"
LESS = {
    Criterion.DEPTH: "; try less contact.depth",
    Criterion.FORCE: "; try less contact.force, which is per mm of finger (1 N on 10 mm are 0.1 N/mm)",
}
SMALL_ALONE = "; `kinematics: {value: small, ...}` in the device file skips finite strain (docs/troubleshooting.md)"
SHEAR_ALONE = "; `interfaces: {value: shear, ...}` in the device file skips the frictionless case"


@contextmanager
def named(what: str, advice: Callable[[ContactError], str] = lambda error: "") -> Iterator[None]:
    """Name in every ContactError what was being solved, and say what else may help."""
    try:
        yield
    except ContactError as error:
        error.args = (f"{what}: {error}{advice(error)}",)
        raise


def named_pressing(scene: Scene, interface: Interface) -> AbstractContextManager[None]:
    """`named`, for pre-indentation, which goes the deeper the wider the row is."""
    criterion = scene.model.contact.criterion

    def advice(error: ContactError) -> str:
        # what touches no skin at any height fails with `touch` as well
        touched = not isinstance(error, CriterionError) or error.touched
        less = LESS.get(criterion, TOUCH if criterion is Criterion.FULL and touched else NARROWER)
        return f"{less}{left_out(scene, interface)}"

    return named(f"device={scene.device.name}, interface={interface}, pre-indentation", advice)


def named_stimulus(scene: Scene, condition: Condition, interface: Interface) -> AbstractContextManager[None]:
    """`named`, for the stimulus of a condition; nothing helps against depth."""
    case = f"device={scene.device.name}, condition={condition.name}, interface={interface}"
    return named(case, lambda error: "" if isinstance(error, DepthError) else left_out(scene, interface))


def left_out(scene: Scene, interface: Interface) -> str:
    """What a device's file may leave out where it cannot be solved."""
    finite, frictionless = scene.kinematics is Kinematics.FINITE, interface is Interface.FRICTIONLESS
    return (SMALL_ALONE if finite else "") + (SHEAR_ALONE if frictionless else "")
