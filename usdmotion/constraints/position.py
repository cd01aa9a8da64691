"""The point of a joint is at a goal."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import composite_point, trajectory
from usdmotion.tasks import PointTask


@dataclass(frozen=True, eq=False, kw_only=True)
class PositionConstraint(Constraint):
    """Holds a point of a joint at its goals, or on its original trajectory."""

    schema: ClassVar[str] = "MotionPositionConstraint"
    axes: str = attribute("xyz", frame="goals")
    """The axes of the goal's space along which it is held."""

    def tasks(self, cast: Cast) -> Iterator[PointTask]:
        """Yield one point task."""
        effector = [self.effector(cast)]
        original = trajectory(cast, effector)
        yield composite_point(cast, self.goals, effector, original, self.axes, self.path)
