"""A point stays inside a shape, or outside of it."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute, relation
from usdmotion.constraints.constraint import Constraint
from usdmotion.errors import SceneError
from usdmotion.kernels import Shape
from usdmotion.tasks import DistanceTask


@dataclass(frozen=True, eq=False, kw_only=True)
class Region:
    """All places that are nearer to a shape than a margin; it may move.

    A sphere is a margin about a point, a capsule one about a segment.
    """

    path: str = ""
    """Path of its prim."""
    shape: Shape = Shape.BOX
    extent: Floats = field(default_factory=lambda: np.zeros(3))
    """Half the shape's size along its axes, a cylinder's radius first [m], (3,) or (F, 3)."""
    margin: Floats | float = 0.0
    """[m], one number or shape (frame_count,)."""
    translation: Floats = field(default_factory=lambda: np.zeros(3))
    """Where its origin is in the world [m], shape (3,) or (frame_count, 3)."""
    rotation: Floats = field(default_factory=lambda: np.array([0.0, 0.0, 0.0, 1.0]))
    """How its axes lie in the world, xyzw, shape (4,) or (frame_count, 4)."""

    @property
    def walls(self) -> "tuple[Region, ...]":
        """The regions, each with one wall near any place, whose common part it is.

        Inside a corner a point is held by every wall that it touches, and not by the nearest only.
        """
        if self.shape == Shape.HALF_SPACE or np.any(self.margin):
            return (self,)
        if self.shape == Shape.BOX:
            return tuple(self._without(axis) for axis in ([1, 2], [2, 0], [0, 1]))
        return (self._without([2]), replace(self._without([0, 1]), shape=Shape.BOX))

    def _without(self, axes: list[int]) -> "Region":
        extent = np.array(self.extent)
        extent[..., axes] = np.inf
        return replace(self, extent=extent)


@dataclass(frozen=True, eq=False, kw_only=True)
class RegionConstraint(Constraint):
    """Keeps a point of a joint inside a region or outside of it; free until it touches a wall."""

    schema: ClassVar[str] = "MotionRegionConstraint"
    region: Region | None = relation("region")
    """The shape of the stage."""
    side: str = attribute("outside")
    """`inside` or `outside`."""

    def tasks(self, cast: Cast) -> Iterator[DistanceTask]:
        """Yield a one-sided distance task for each wall."""
        if self.region is None:
            raise SceneError(f"<{self.path}> has no region; name a shape in usdmotion:region")
        if self.side not in ("inside", "outside"):
            raise SceneError(f"<{self.path}> stays '{self.side}'; use inside or outside")
        outside = self.side == "outside"
        for wall in (self.region,) if outside else self.region.walls:
            yield DistanceTask(
                (self.effector(cast),),
                np.broadcast_to(wall.translation, (cast.frame_count, 3)),
                wall.margin,
                1 if outside else -1,
                wall.shape,
                wall.extent,
                wall.rotation,
            )
