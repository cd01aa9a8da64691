"""Two points are so far apart, or so far at least or at most."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast, Joint
from usdmotion.constraints.attributes import attribute, relation
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import Shares, composite_point, trajectory
from usdmotion.errors import SceneError
from usdmotion.tasks import DistanceTask, PointTask, Term

_BOUNDS = {"equal": 0, "atLeast": 1, "atMost": -1}


@dataclass(frozen=True, eq=False, kw_only=True)
class DistanceConstraint(Constraint):
    """Keeps the distance of a point from another joint's point, or from the mean of the goals.

    While the goals are not fully on, the distance asked for is as much of the original one. A bound
    costs nothing until it is touched. Two points that are to be one are held together in all three
    directions.
    """

    schema: ClassVar[str] = "MotionDistanceConstraint"
    other_skeleton: str = relation("skeleton")
    """Path of the Skeleton of the other joint; none is the same one."""
    other_joint: str = attribute("")
    """Token of the other joint; none is the distance to the goals."""
    other_point: Floats = attribute(
        lambda: np.zeros(3), unit="length", frame="other_joint", skeleton="other_skeleton"
    )
    """The other point in that joint's frame [m], shape (3,) or (frame_count, 3)."""
    distance: Floats | float = attribute(0.0, unit="length", animated=True)
    """How far apart they are to be [m], one number or shape (frame_count,)."""
    bound: str = attribute("equal")
    """`equal`, `atLeast` or `atMost`."""

    def tasks(self, cast: Cast) -> Iterator[PointTask | DistanceTask]:
        """Yield one distance task, or one point task where the distance is to be nothing."""
        if self.bound not in _BOUNDS:
            raise SceneError(
                f"<{self.path}> bounds a distance by '{self.bound}'; use {', '.join(_BOUNDS)}"
            )
        between = self._between(cast)
        asked = self._asked(cast, between)
        if self.bound != "atLeast" and not asked.any():
            yield between
        else:
            yield DistanceTask(between.terms, between.target, asked, _BOUNDS[self.bound])

    def needs(self, times: Floats, frames: slice) -> slice:
        """Return the frames; all of the clip where the distance is nothing on some of them.

        Whether the two points are held together is decided for the clip, and not for a frame.
        """
        nothing = np.asarray(self.distance) == 0.0
        mixed = bool(self.goals) or not nothing.all()
        return slice(0, len(times)) if nothing.any() and mixed else frames

    def recruited(self, cast: Cast) -> Iterable[int]:
        """Return the nodes that it may move: the chains of both joints, if it names none."""
        own = list(super().recruited(cast))
        if self.recruits or self._other is None or self._other[0] != self.skeleton:
            return own
        return [*own, *cast.chain(cast.node(self._other, self.path))]

    def movable(self, cast: Cast) -> Iterable[int]:
        """Return every node that can move either point."""
        other = () if self._other is None else cast.ancestors(cast.node(self._other, self.path))
        return {*super().movable(cast), *other}

    @property
    def _other(self) -> Joint | None:
        return (
            (self.other_skeleton or self.skeleton, self.other_joint) if self.other_joint else None
        )

    def _between(self, cast: Cast) -> PointTask:
        """Return the task that would bring the two points together."""
        effector = self.effector(cast)
        if self._other is not None:
            other = Term(cast.node(self._other, self.path), self.other_point, -1.0)
            return PointTask((effector, other), np.zeros((cast.frame_count, 3)))
        if not self.goals:
            raise SceneError(
                f"<{self.path}> is a distance to nothing; set usdmotion:otherJoint or add a goal"
            )
        original = trajectory(cast, [effector])
        shares = Shares.full(self.goals, cast.times)
        return composite_point(cast, self.goals, [effector], original, "xyz", self.path, shares)

    def _asked(self, cast: Cast, between: PointTask) -> Floats:
        """Return the distance that is asked for [m], shape (frame_count,)."""
        asked = np.broadcast_to(self.distance, cast.frame_count)
        if self._other is not None:
            return asked
        original = np.linalg.norm(trajectory(cast, between.terms) - between.target, axis=1)
        if self.bound == "atLeast":
            original = np.minimum(original, asked)
        elif self.bound == "atMost":
            original = np.maximum(original, asked)
        blend = Shares.of(self.goals, cast.times).blend
        return np.asarray(blend * asked + (1.0 - blend) * original)
