"""The frame in which a constraint gives places, which may move."""

from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast, Joint
from usdmotion.kernels import multiply, rotate
from usdmotion.tasks import Axes, PointTask, Term, TurnGoal


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

    def inside(self, cast: Cast, world: Floats, asked_by: str) -> Floats:
        """Return world trajectories of the input as seen from it, shape (frame_count, 3)."""
        node = self.node(cast, asked_by)
        if node < 0:
            return rotate(self.rotation * (-1.0, -1.0, -1.0, 1.0), world - self.translation)
        back = cast.orientations[:, node] * (-1.0, -1.0, -1.0, 1.0)
        return rotate(back, world - cast.positions[:, node])

    def hold(self, cast: Cast, effector: Term, places: Floats, asked_by: str) -> PointTask:
        """Return the task that keeps an effector at places given in it [m], (frame_count, 3)."""
        node = self.node(cast, asked_by)
        if node >= 0:
            nothing = np.zeros((cast.frame_count, 3))
            return PointTask((effector, Term(node, places, -1.0)), nothing, Axes())
        world = self.translation + rotate(
            np.broadcast_to(self.rotation, (cast.frame_count, 4)), places
        )
        return PointTask((effector,), world, Axes())

    def turn(self, cast: Cast, orientation: Floats, asked_by: str) -> TurnGoal:
        """Return the orientation given in it as the goal of a rotation task."""
        node = self.node(cast, asked_by)
        turns = np.broadcast_to(orientation, (cast.frame_count, 4))
        if node < 0:
            turns = multiply(np.broadcast_to(self.rotation, turns.shape), turns)
        return TurnGoal(turns, np.ones(cast.frame_count), node)
