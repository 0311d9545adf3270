"""What vibration needs besides a scene: how tissue relaxes, its density, when inertia forbids a prediction."""

from __future__ import annotations

from dataclasses import dataclass

from ..requirements import require, require_positive


@dataclass(frozen=True)
class Relaxation:
    """How tissue relaxes (see `viscoelasticity`).

    shares: of the instantaneous modulus that relax [1]. times: in which they do [s]. layers: names of those that relax.

    Raises SceneError if shares and times are not as many or not positive, two times are equal, or shares sum to 1 or
    more.
    """

    shares: tuple[float, ...]
    times: tuple[float, ...]
    layers: tuple[str, ...]

    def __post_init__(self) -> None:
        require(
            len(self.shares) == len(self.times),
            f"vibration: shares and times must be as many, found {len(self.shares)} and {len(self.times)}",
        )
        require_positive("vibration", **{f"share {i + 1}": share for i, share in enumerate(self.shares)})
        require_positive("vibration", **{f"time {i + 1}": time for i, time in enumerate(self.times)})
        require(len(set(self.times)) == len(self.times), f"vibration: times must differ, found {list(self.times)}")
        require(
            sum(self.shares) < 1.0,
            f"vibration: shares must leave something that does not relax, found a sum of {sum(self.shares):g}",
        )


@dataclass(frozen=True)
class VibrationRule:
    """What vibration needs besides.

    relaxation. density: of all tissue [t/mm3]. inertia_limit: change of receptor strain by inertia [1] beyond which
    there is no prediction. steps: of a cycle [1]. Raises SceneError unless these three are positive.
    """

    relaxation: Relaxation
    density: float
    inertia_limit: float
    steps: int

    def __post_init__(self) -> None:
        require_positive("vibration", density=self.density, inertia_limit=self.inertia_limit, steps=self.steps)
