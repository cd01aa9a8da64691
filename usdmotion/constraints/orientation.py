"""A joint has the orientation of a goal."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import composite_turn
from usdmotion.tasks import RotationTask


@dataclass(frozen=True, eq=False, kw_only=True)
class OrientationConstraint(Constraint):
    """Holds the orientation of a joint at its goals, or on its original course."""

    schema: ClassVar[str] = "MotionOrientationConstraint"
    unit: ClassVar[str] = "deg"
    tolerance: float = attribute(0.0)
    """What counts as met [degrees]; 0 is 1 degree."""
    rotation: Floats = attribute(lambda: np.array([0.0, 0.0, 0.0, 1.0]), frame="joint")
    """Joint frame × rotation has the goal's orientation; xyzw."""
    free_axis: Floats = attribute(lambda: np.zeros(3), frame="joint")
    """Axis of the joint's frame about which turning is left free; zero for none."""

    def tasks(self, cast: Cast) -> Iterator[RotationTask]:
        """Yield one rotation task."""
        yield composite_turn(
            cast, self.goals, self.node(cast), self.rotation, self.free_axis, self.path
        )
