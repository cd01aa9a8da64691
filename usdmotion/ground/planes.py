"""A plane without end, at rest or moving."""

from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.errors import SceneError
from usdmotion.ground.axes import at_times

_STEEPEST = np.cos(np.radians(85.0))
"""A plane steeper than this is a wall, and nothing stands on it."""


@dataclass(frozen=True, eq=False)
class PlaneGround:
    """A plane without end; nothing of it is overhead, so that it may be lifted at will."""

    point: Floats
    """A point of it in the world [m], shape (3,) or (sample_count, 3)."""
    normal: Floats
    """Its normal, pointing either way, shape (3,) or (sample_count, 3)."""
    up: Floats
    """The direction away from the ground, shape (3,)."""
    times: Floats = field(default_factory=lambda: np.zeros(1))
    """Seconds of the samples, shape (sample_count,)."""

    def __post_init__(self) -> None:
        normal = np.atleast_2d(np.asarray(self.normal, dtype=np.float64))
        normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        normal = normal * np.where(normal @ self.up < 0.0, -1.0, 1.0)[:, None]
        if not (normal @ self.up > _STEEPEST).all():
            raise SceneError("a plane is upright, so that nothing can stand on it; lay it down")
        count = len(self.times)
        point = np.broadcast_to(np.atleast_2d(self.point), (count, 3))
        object.__setattr__(self, "point", seal(point, count, 3, name="point"))
        normal = np.broadcast_to(normal, (count, 3))
        object.__setattr__(self, "normal", seal(normal, count, 3, name="normal"))
        object.__setattr__(self, "up", seal(self.up, 3, name="up"))
        object.__setattr__(self, "times", seal(self.times, count, name="times"))

    def under(self, points: Floats, times: Floats) -> tuple[Floats, Floats]:
        """Return heights [m] and normals, as `Ground` has it; it is everywhere."""
        origin = at_times(self.point, self.times, times)[:, None]
        normal = at_times(self.normal, self.times, times)[:, None]
        normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
        above = np.sum((points - origin) * normal, axis=-1) / (normal @ self.up)
        return points @ self.up - above, np.array(np.broadcast_to(normal, points.shape))
