"""Triangles to stand on, at rest or moving."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from usdmotion.arrays import Floats, Ints, seal
from usdmotion.ground.axes import across, at_times
from usdmotion.kernels.surfaces import count_cells, fill_cells, surface_under

STEP = 0.5
"""What is higher than a point by more than this is overhead: a roof, a table top [m]."""
_MOST = 1 << 20
"""Most cells of a grid."""


@dataclass(frozen=True, eq=False)
class MeshGround:
    """The surface of triangles, whichever way they are turned; beside them there is no ground."""

    points: Floats
    """World positions [m], shape (point_count, 3), or (sample_count, point_count, 3)."""
    triangles: Ints
    """The three points of each triangle, shape (triangle_count, 3)."""
    up: Floats
    """The direction away from the ground, shape (3,)."""
    times: Floats = field(default_factory=lambda: np.zeros(1))
    """Seconds of the samples, shape (sample_count,)."""

    def __post_init__(self) -> None:
        points = np.asarray(self.points, dtype=np.float64)
        points = points if points.ndim == 3 else points[None]
        count = len(self.times)
        object.__setattr__(self, "points", seal(points, count, None, 3, name="points"))
        triangles = seal(self.triangles, None, 3, dtype=np.int64, name="triangles")
        object.__setattr__(self, "triangles", triangles)
        object.__setattr__(self, "up", seal(self.up, 3, name="up"))
        object.__setattr__(self, "times", seal(self.times, count, name="times"))

    def under(self, points: Floats, times: Floats) -> tuple[Floats, Floats]:
        """Return heights [m] and normals, as `Ground` has it."""
        if len(self.times) == 1:
            heights, normals = self._still.under(points.reshape(-1, 3))
            return heights.reshape(points.shape[:-1]), normals.reshape(points.shape)
        heights, normals = np.empty(points.shape[:-1]), np.empty(points.shape)
        for frame, time in enumerate(times):
            placed = at_times(self.points, self.times, np.array([time]))[0]
            surface = _Surface(placed, self.triangles, self.up)
            heights[frame], normals[frame] = surface.under(points[frame])
        return heights, normals

    @cached_property
    def _still(self) -> "_Surface":
        return _Surface(self.points[0], self.triangles, self.up)


class _Surface:
    """Triangles at one time, in the cells of a grid."""

    def __init__(self, points: Floats, triangles: Ints, up: Floats) -> None:
        self._axes = np.vstack([across(up), up])
        corners = (points @ self._axes.T)[triangles]
        sides = corners[:, 1:] - corners[:, :1]
        normals = np.cross(sides[:, 0], sides[:, 1])
        normals *= np.where(normals[:, 2:] < 0.0, -1.0, 1.0)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        self._normals = normals / np.maximum(lengths, 1e-300) @ self._axes
        self._corners = np.ascontiguousarray(corners)
        self._bin()

    def _bin(self) -> None:
        """Sort the triangles into cells, about as many as there are triangles."""
        flat = self._corners[..., :2].reshape(-1, 2)
        self._low = flat.min(axis=0) if len(flat) else np.zeros(2)
        extent = np.maximum((flat.max(axis=0) if len(flat) else np.ones(2)) - self._low, 1e-6)
        cells = min(max(len(self._corners), 1), _MOST)
        side = np.sqrt(extent.prod() / cells)
        self._shape = np.clip(np.ceil(extent / side), 1, cells).astype(np.int64)
        # A little more than the extent, so that its far edge is inside.
        self._size = extent * (1.0 + 1e-9) / self._shape
        grid = self._corners, self._low, self._size, self._shape
        self._starts = np.zeros(int(self._shape.prod()) + 1, dtype=np.int64)
        count_cells(*grid, self._starts)
        self._inside = np.empty(int(self._starts[-1]), dtype=np.int64)
        fill_cells(*grid, self._starts[:-1].copy(), self._inside)

    def under(self, points: Floats) -> tuple[Floats, Floats]:
        """(P, 3) to (P,), (P, 3): heights and normals; up where there is no ground."""
        heights, triangles = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
        grid = self._corners, self._low, self._size, self._shape, self._starts, self._inside
        surface_under(*grid, points @ self._axes.T, STEP, heights, triangles)
        # One more, straight up, for −1.
        normals = np.concatenate([self._normals, self._axes[2:]])[triangles]
        return heights, normals
