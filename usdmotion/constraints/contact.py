"""A joint's frame, a line of it or a point of it is held in place for a while."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.space import Space
from usdmotion.errors import SceneError
from usdmotion.kernels import rotate
from usdmotion.tasks import RotationTask, Task, Term

_APART = 0.25
"""How far the two points are apart that hold a line [m]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactConstraint(Constraint):
    """What a motion was found to obey, or is to obey: a contact that can be enforced as it is."""

    schema: ClassVar[str] = "MotionContactConstraint"
    kind: str = attribute("space")
    """`space`: the frame is held; `line`: it may turn about the axis; `point`: it may turn."""
    location: Floats = attribute(lambda: np.zeros(3), unit="length", frame="space")
    """Where the effector's point is held, in the space [m]."""
    orientation: Floats = attribute(lambda: np.array([0.0, 0.0, 0.0, 1.0]))
    """Orientation of the joint there, xyzw."""
    axis: Floats = attribute(lambda: np.array([0.0, 0.0, 1.0]))
    """Direction of the line, in the space."""
    template: bool = attribute(False)
    """Whether it is an example for detection."""
    residual: float = attribute(0.0)
    """How well the motion obeyed it when it was detected."""
    space: Space = field(default_factory=Space)
    """The frame of location, orientation and axis."""

    def tasks(self, cast: Cast) -> Iterator[Task]:
        """Yield point tasks, and a rotation task where the whole frame is held."""
        if self.kind not in ("space", "line", "point"):
            raise SceneError(
                f"<{self.path}> is of the kind '{self.kind}'; use space, line or point"
            )
        effector = self.effector(cast)
        here = np.broadcast_to(self.location, (cast.frame_count, 3))
        yield self.space.hold(cast, effector, here, self.path)
        if self.kind == "line":
            step = _APART * self.axis / np.linalg.norm(self.axis)
            within = rotate(self.orientation * (-1.0, -1.0, -1.0, 1.0), step)
            other = Term(effector.node, self.point + within)
            yield self.space.hold(cast, other, here + step, self.path)
        elif self.kind == "space":
            goal = self.space.turn(cast, self.orientation, self.path)
            original = cast.orientations[:, effector.node]
            yield RotationTask(effector.node, (goal,), original, np.ones(cast.frame_count))
