"""The contract between what stands and what it stands on."""

from typing import Protocol, runtime_checkable

from usdmotion.arrays import Floats


@runtime_checkable
class Ground(Protocol):
    """A surface to stand on, which may move: a plane, meshes, a function (2005, section 7)."""

    def under(self, points: Floats, times: Floats) -> tuple[Floats, Floats]:
        """Return how high the ground is under some points, and how it lies there.

        Args:
            points: World positions [m], shape (frame_count, point_count, 3).
            times: Seconds of the frames, shape (frame_count,).

        Returns:
            Height along the up axis [m], shape (frame_count, point_count), not a number where there
            is no ground; and the unit normals, shape (frame_count, point_count, 3).
        """
        ...
