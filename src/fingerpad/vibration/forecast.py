"""The whole frequency table of a scene in one process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from threadpoolctl import threadpool_limits

from ..prediction.edges import mesh_device
from ..prediction.scoring import condense_mesh
from ..scene.scene import Scene
from .frequency import vibration_rows


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
