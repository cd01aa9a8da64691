"""A point of a joint leaves its trajectory for a curve through given points, and rejoins it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import trajectory
from usdmotion.constraints.space import Space
from usdmotion.curves import ease, kochanek_bartels, time_curve
from usdmotion.errors import SceneError
from usdmotion.tasks import PointTask


@dataclass(frozen=True, eq=False, kw_only=True)
class TrajectoryConstraint(Constraint):
    """The shape constraint of 2004, section 4.2.

    The curve leaves the input trajectory at the first of `times` and rejoins it at the last, with
    the effector's own velocity, so its activity is not eased.
    """

    schema: ClassVar[str] = "MotionTrajectoryConstraint"
    keys: tuple[float, ...] = attribute((), unit="time")
    """When each point is reached [s]."""
    releases: tuple[float, ...] = attribute((), unit="time")
    """When it is left again [s]; none: at its key."""
    points: Floats = attribute(lambda: np.zeros((0, 3)), unit="length", frame="space")
    """The points in the space [m], shape (point_count, 3)."""
    tension: tuple[float, ...] = attribute(())
    """Of each point; none: 1 where it is released later than reached, else 0."""
    continuity: tuple[float, ...] = attribute(())
    """Of each point; none: 0."""
    bias: tuple[float, ...] = attribute(())
    """Of each point; none: 0."""
    space: Space = field(default_factory=Space)
    """The frame of the points."""

    def tasks(self, cast: Cast) -> Iterator[PointTask]:
        """Yield one point task."""
        self._check()
        effector = self.effector(cast)
        original = self.space.inside(cast, trajectory(cast, [effector]), self.path)
        places = np.array(original)
        on = self._on(cast)
        places[on] = self._curve(cast.times, original)[on]
        yield self.space.hold(cast, effector, places, self.path)

    def needs(self, times: Floats, frames: slice) -> slice:
        """Return the frames, and those of the whole curve: its ends lie on the input trajectory."""
        curve = self.span(times)
        if curve.stop <= frames.start or frames.stop <= curve.start:
            return frames
        # Position and velocity at an end are between two frames, and a velocity needs one more.
        start, stop = curve.start - 2, curve.stop + 2
        return slice(max(min(frames.start, start), 0), min(max(frames.stop, stop), len(times)))

    def eased(self, cast: Cast) -> Floats:
        """Return its activity: the curve itself leaves and rejoins."""
        return np.asarray(self.activity * self._on(cast))

    def movable(self, cast: Cast) -> Iterable[int]:
        """Return every node that can move its effector or its space."""
        return {*super().movable(cast), *self.space.movable(cast, self.path)}

    def _on(self, cast: Cast) -> Bools:
        ends = (self.times[0], self.times[-1])
        return np.asarray(ease(cast.times, ends) > 0.0)

    def _curve(self, times: Floats, original: Floats) -> Floats:
        """Return the curve at all times, in the space."""
        ends = np.array([self.times[0], self.times[-1]])
        first, last = (self._at(times, original, end) for end in ends)
        velocity = np.gradient(original, times, axis=0) if len(times) > 1 else 0.0 * original
        velocities = self._at(times, velocity, ends[0]), self._at(times, velocity, ends[1])
        keys = np.array([ends[0], *self.keys, ends[1]])
        releases = np.array([ends[0], *(self.releases or self.keys), ends[1]])
        u, knots = time_curve(times, keys, releases)
        points = np.concatenate([first[None], self.points, last[None]])
        return kochanek_bartels(u, knots, points, self._shape(keys, releases), velocities)

    def _shape(self, keys: Floats, releases: Floats) -> Floats:
        shape = np.zeros((len(keys), 3))
        shape[:, 0] = releases > keys
        for column, values in enumerate((self.tension, self.continuity, self.bias)):
            if values:
                shape[1:-1, column] = values
        return shape

    @staticmethod
    def _at(times: Floats, values: Floats, time: float) -> Floats:
        return np.array([np.interp(time, times, column) for column in values.T])

    def _check(self) -> None:
        count = len(self.points)
        lists = (self.releases, self.tension, self.continuity, self.bias)
        moments = np.array(
            [
                *self.times[:1],
                *np.stack([self.keys, self.releases or self.keys], axis=1).ravel(),
                *self.times[-1:],
            ]
        )
        if len(self.times) < 2:
            wrong = "does not say when it leaves and rejoins; give usdmotion:times"
        elif len(self.keys) != count or any(each and len(each) != count for each in lists):
            wrong = (
                f"has {count} points and other counts of keys, releases or shapes; make them equal"
            )
        elif np.any(np.diff(moments) < 0.0) or np.any(
            np.diff([moments[0], *self.keys, moments[-1]]) <= 0.0
        ):
            wrong = (
                "has keys and releases that are not in order between its times; put them in order"
            )
        else:
            return
        raise SceneError(f"<{self.path}> {wrong}")
