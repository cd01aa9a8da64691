"""A joint's frame, a line of it or a point of it is held for a while, or slides."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.approach import gone, turned
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import trajectory
from usdmotion.constraints.space import Space
from usdmotion.curves import plateau
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, from_vector, multiply, rotate
from usdmotion.tasks import Axes, PointTask, RotationTask, Task, Term

APART = 0.25
"""How far the two points are apart that hold a line [m]."""
_HELD = {
    "space": (True, True, True),
    "line": (True, True, True),
    "point": (True, True, True),
    "plane": (False, False, True),
    "slide": (True, True, False),
}
"""Along which axes the point is held, the last of which is the contact's own axis."""
_WITH_AXIS = ("line", "plane", "slide")


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactConstraint(Constraint):
    """What a motion was found to obey, or is to obey: a contact that can be enforced as it is."""

    schema: ClassVar[str] = "MotionContactConstraint"
    kind: str = attribute("space")
    """`space`: the frame is held; `line`: it may turn about the axis; `point`: it may turn;
    `plane`: and its point may go along the plane; `slide`: along a line."""
    location: Floats = attribute(lambda: np.zeros(3), unit="length", frame="space")
    """Where the effector's point is held, in the space [m]; a place on the plane or the line."""
    orientation: Floats = attribute(
        lambda: np.array([0.0, 0.0, 0.0, 1.0]), frame="space", of="joint"
    )
    """Orientation of the joint there, xyzw."""
    axis: Floats = attribute(lambda: np.array([0.0, 0.0, 1.0]), frame="space")
    """Direction of the line, or of the normal of the plane, in the space."""
    template: bool = attribute(False)
    """Whether it is an example for detection."""
    residual: float = attribute(0.0, unit="length")
    """How well the motion obeyed it when it was detected [m]."""
    space: Space = field(default_factory=Space)
    """The frame of location, orientation and axis."""

    def tasks(self, cast: Cast) -> Iterator[Task]:
        """Yield point tasks, and a rotation task where the whole frame is held.

        While it eases, what is asked goes along with the motion, as far from it as where it is held
        is at that end of the contact: nothing is drawn to a place where it is not yet, or no more.
        """
        self._check()
        effector = self.effector(cast)
        yield self._held(cast, effector)
        if self.kind == "line":
            step = APART * self.axis / np.linalg.norm(self.axis)
            within = rotate(conjugate(self.orientation), step)
            yield self._held(cast, Term(effector.node, self.point + within), step)
        elif self.kind == "space":
            original = cast.orientations[:, effector.node]
            facing = self.space.facing(cast, original, self.path)
            held = np.broadcast_to(self.orientation, facing.shape)
            course = multiply(held, turned(cast.times, self.times, facing))
            goal = self.space.turn(cast, course, self.path)
            yield RotationTask(effector.node, (goal,), original, np.ones(cast.frame_count))

    def needs(self, times: Floats, frames: slice) -> slice:
        """Return the frames, and those at which the contact begins and ends if it eases there."""
        asking = self.span(times)
        if len(self.times) < 4 or asking.stop <= frames.start or frames.stop <= asking.start:
            return frames
        # Where it begins or ends is between two frames.
        start, stop = asking.start - 1, asking.stop + 1
        return slice(max(min(frames.start, start), 0), min(max(frames.stop, stop), len(times)))

    def held(self, times: Floats) -> tuple[float, float]:
        """Return the first and the last time at which it is fully on [s].

        Args:
            times: Seconds of the clip, all of which it holds where it has no key times.
        """
        return plateau(self.times, (float(times[0]), float(times[-1])))

    @property
    def stays(self) -> bool:
        """Whether it keeps its point in place, and is not switched off.

        An example for detection does too: it is enforced like any other.
        """
        return all(_HELD.get(self.kind, (False,))) and bool(np.any(np.asarray(self.activity) > 0.0))

    def movable(self, cast: Cast) -> Iterable[int]:
        """Return every node that can move its effector or its space."""
        return {*super().movable(cast), *self.space.movable(cast, self.path)}

    def _held(self, cast: Cast, effector: Term, step: Floats | float = 0.0) -> PointTask:
        """Return the task that keeps a point where the kind lets it be, a step from the place."""
        inside = self.space.inside(cast, trajectory(cast, [effector]), self.path)
        places = self.location + step + gone(cast.times, self.times, inside)
        held = _HELD[self.kind]
        axes = Axes(held) if all(held) else Axes(held, rotation=_onto(self.axis))
        return self.space.hold(cast, effector, places, self.path, axes)

    def _check(self) -> None:
        if self.kind not in _HELD:
            *most, last = _HELD
            raise SceneError(
                f"<{self.path}> is of the kind '{self.kind}'; use {', '.join(most)} or {last}"
            )
        if self.kind in _WITH_AXIS and not np.any(self.axis):
            raise SceneError(f"<{self.path}> has an axis of zero; give usdmotion:axis a direction")


def _onto(axis: Floats) -> Floats:
    """Return the shortest rotation that turns z onto an axis, xyzw."""
    x, y, z = axis / np.linalg.norm(axis)
    sine = np.hypot(x, y)
    around = np.array([-y, x, 0.0]) / sine if sine > 0.0 else np.array([1.0, 0.0, 0.0])
    return from_vector(np.arctan2(sine, z) * around)
