"""The whole frequency table of a scene in one process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from threadpoolctl import threadpool_limits

from ..errors import UsageError
from ..prediction.edges import mesh_device
from ..prediction.scoring import condense_mesh
from ..requirements import is_number
from ..scene.problems import as_python
from ..scene.scene import Scene
from .frequency import vibration_rows

LOWEST, HIGHEST = 0.1, 1000.0  # frequency [Hz]; source: as in the schema of `frequency_hz`


def at_frequencies(scene: Scene, frequencies: Sequence[float]) -> Scene:
    """The scene with other frequencies [Hz], if there are any. Raises UsageError if it has none, or cannot have one,
    and SceneError if a condition has no actuator at its peak where it is read.
    """
    device = scene.device
    if not device.cycles:
        raise UsageError(
            f"{device.name}: found displacements that are given in time; allowed: a stimulus of kind phased or"
            " alternating, which can be a vibration (alternating, relative_to: leader, absolute 0: every second"
            " actuator rests)"
        )
    if not frequencies and not device.frequencies:
        raise UsageError(f"{device.name}: found no frequency; give one, or stimulus.frequency_hz in the device file")
    for frequency in frequencies:
        if not (is_number(frequency) and LOWEST <= frequency <= HIGHEST):
            raise UsageError(f"frequency: found {as_python(frequency)}; allowed: {LOWEST:g} to {HIGHEST:g} [Hz]")
    wanted = tuple(sorted(set(frequencies))) or device.frequencies
    return scene.with_device(frequencies=wanted)


def vibration_forecast(scene: Scene, step: Callable[[], object] = lambda: None) -> list[dict[str, Any]]:
    """Rows of the frequency table of a scene, as `vibration_rows`, on a mesh of its own. step: called after each of
    `steps`. Raises MeshError, CondensationError.
    """
    with threadpool_limits(1):  # two threads take longer (decision 14), and results depend on their number
        section = mesh_device(scene)
        step()
        condensed = condense_mesh(scene, section)
        step()
        return vibration_rows(scene, section, condensed, step)


def steps(scene: Scene) -> int:
    """How often `vibration_forecast` calls its `step`: after meshing and condensation, and for slow cycles and each
    frequency after what it needs condensed and after every condition at every interface.
    """
    device = scene.device
    speeds = 1 + len(device.frequencies)
    return 2 + speeds * (1 + len(device.interfaces()) * len(device.cycles))
