"""The frame in which a constraint gives places, which may move."""

from dataclasses import dataclass, field, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast, Joint
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.tasks import Axes, PointTask, Term, TurnGoal

_ALL = Axes()


@dataclass(frozen=True, eq=False)
class Space:
    """The world, a prim, or a joint."""

    translation: Floats = field(default_factory=lambda: np.zeros(3))
    """Where its origin is in the world [m], shape (3,) or (frame_count, 3)."""
    rotation: Floats = field(default_factory=lambda: np.array([0.0, 0.0, 0.0, 1.0]))
    """How its axes lie in the world, xyzw, shape (4,) or (frame_count, 4)."""
    joint: Joint | None = None
    """The joint that it is instead; it may be moved by the solve."""

    def node(self, cast: Cast, asked_by: str) -> int:
        """Return the node of its joint, -1 where it is none."""
        return -1 if self.joint is None else cast.node(self.joint, asked_by)

    def movable(self, cast: Cast, asked_by: str) -> set[int]:
        """Return every node that can move it; none where it is no joint."""
        node = self.node(cast, asked_by)
        return set(cast.ancestors(node)) if node >= 0 else set()

    def inside(self, cast: Cast, world: Floats, asked_by: str) -> Floats:
        """Return world trajectories of the input as seen from it, shape (frame_count, 3)."""
        node = self.node(cast, asked_by)
        if node < 0:
            return rotate(self.rotation * (-1.0, -1.0, -1.0, 1.0), world - self.translation)
        back = cast.orientations[:, node] * (-1.0, -1.0, -1.0, 1.0)
        return rotate(back, world - cast.positions[:, node])

    def facing(self, cast: Cast, world: Floats, asked_by: str) -> Floats:
        """Return world orientations of the input as seen from it, shape (frame_count, 4)."""
        node = self.node(cast, asked_by)
        own = np.broadcast_to(self.rotation, world.shape)
        return multiply(conjugate(own if node < 0 else cast.orientations[:, node]), world)

    def hold(
        self, cast: Cast, effector: Term, places: Floats, asked_by: str, axes: Axes = _ALL
    ) -> PointTask:
        """Return the task that keeps an effector at places given in it [m], (frame_count, 3).

        Args:
            cast: Who takes part.
            effector: The point that is held.
            places: Where.
            asked_by: Whom to name in an error.
            axes: The directions along which it is held, given in the space.
        """
        node = self.node(cast, asked_by)
        if node >= 0:
            nothing = np.zeros((cast.frame_count, 3))
            return PointTask(
                (effector, Term(node, places, -1.0)), nothing, replace(axes, node=node)
            )
        turns = np.broadcast_to(self.rotation, (cast.frame_count, 4))
        world = self.translation + rotate(turns, places)
        if axes.rotation is not _ALL.rotation:
            axes = replace(axes, rotation=multiply(turns, axes.rotation))
        return PointTask((effector,), world, axes)

    def turn(self, cast: Cast, orientation: Floats, asked_by: str) -> TurnGoal:
        """Return the orientation given in it as the goal of a rotation task."""
        node = self.node(cast, asked_by)
        turns = np.broadcast_to(orientation, (cast.frame_count, 4))
        if node < 0:
            turns = multiply(np.broadcast_to(self.rotation, turns.shape), turns)
        return TurnGoal(turns, np.ones(cast.frame_count), node)
