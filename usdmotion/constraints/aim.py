"""An axis of a joint points at a goal."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import Shares, composite_point, composite_turn, trajectory
from usdmotion.errors import SceneError
from usdmotion.kernels import rotate
from usdmotion.tasks import AimTask, RotationTask, Term

_NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False, kw_only=True)
class AimConstraint(Constraint):
    """Points an axis, from the effector's point, at the goals, or where it pointed originally.

    The original counts in the composite of the goals as a point on the axis of the input motion, as
    far away as the goals.
    """

    schema: ClassVar[str] = "MotionAimConstraint"
    unit: ClassVar[str] = "deg"
    tolerance: float = attribute(0.0)
    """What counts as met [degrees]; 0 is 1 degree."""
    aim: Floats = attribute(lambda: np.array([0.0, 0.0, 1.0]), frame="joint")
    """The axis in the joint's frame, of any length but zero."""

    def tasks(self, cast: Cast) -> Iterator[AimTask | RotationTask]:
        """Yield one aim task, or without goals the axis' own course as a rotation task."""
        length = np.linalg.norm(self.aim)
        if not length > 0.0:
            raise SceneError(f"<{self.path}> aims along no axis; set usdmotion:aim")
        axis = self.aim / length
        effector = self.effector(cast)
        if not self.goals:
            yield composite_turn(cast, (), effector.node, _NO_TURN, axis, self.path)
            return
        aimed = self._aimed(cast, effector, axis)
        point = composite_point(cast, self.goals, [effector], aimed, "xyz", self.path)
        yield AimTask(point.terms, point.target, axis)

    def _aimed(self, cast: Cast, effector: Term, axis: Floats) -> Floats:
        """Return where the axis points in the input motion [m], shape (frame_count, 3)."""
        eye = trajectory(cast, [effector])
        directions = rotate(cast.orientations[:, effector.node], axis)
        places = [goal for goal in self.goals if goal.mode != "offset"]
        if not places:
            return eye + directions
        shares = Shares.full(places, cast.times)
        task = composite_point(cast, places, [effector], eye, "xyz", self.path, shares)
        away = np.linalg.norm(trajectory(cast, task.terms) - task.target, axis=1)
        return np.asarray(eye + directions * away[:, None])
