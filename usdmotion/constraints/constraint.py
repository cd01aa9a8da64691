"""What every kind of constraint has in common."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.goal import Goal, Shares
from usdmotion.curves import between, ease
from usdmotion.tasks import Demand, Task, Term


@dataclass(frozen=True, eq=False, kw_only=True)
class Constraint:
    """Something that a motion must obey, with its rank among the others."""

    schema: ClassVar[str]
    """Name of the prim type, for example `MotionPositionConstraint`."""
    unit: ClassVar[str] = "m"
    """Unit of what is left of it: `m` or `deg`."""
    weighs: ClassVar[bool] = False
    """Whether it depends on what the body weighs, so that a report says where that is from."""

    path: str
    """Path of its prim."""
    skeleton: str
    """Path of the Skeleton whose joint it holds."""
    goals: tuple[Goal, ...] = ()
    """Where it wants its effector; none keeps the original trajectory."""
    priority: int = attribute(1)
    """Rank: 1 is enforced first; only the order of the numbers counts."""
    weight: Floats | float = attribute(1.0, animated=True)
    """Share inside one priority, one number or shape (frame_count,)."""
    activity: Floats | float = attribute(1.0, animated=True)
    """0..1, one number or shape (frame_count,)."""
    times: tuple[float, ...] = attribute((), unit="time")
    """Key times of its easing [s]: none, two, or four."""
    joint: str = attribute("")
    """Token of the effector's joint."""
    point: Floats = attribute(lambda: np.zeros(3), unit="length", frame="joint")
    """The effector's point in the joint's frame [m], shape (3,) or (frame_count, 3)."""
    recruits: tuple[str, ...] = attribute(())
    """Tokens of the joints it may move; none: from the effector's joint to the root."""
    tolerance: float = attribute(0.0, unit="length")
    """What counts as met [m]; 0 is 1 mm."""

    def tasks(self, cast: Cast) -> Iterable[Task]:
        """Yield what a solver has to do for it; each kind says how."""
        raise NotImplementedError

    def demand(self, cast: Cast) -> Demand:
        """Return its tasks with what they share.

        Raises:
            SceneError: It names a joint that is not there, or asks for what cannot be.
        """
        frames = cast.frame_count
        recruits = np.zeros(cast.node_count, dtype=np.bool_)
        recruits[list(self.recruited(cast))] = True
        return Demand(
            tasks=tuple(self.tasks(cast)),
            priority=self.priority,
            weight=np.broadcast_to(np.maximum(self.weight, 0.0), frames),
            activity=np.broadcast_to(np.clip(self.eased(cast), 0.0, 1.0), frames),
            recruits=recruits,
            moves=frozenset(self.movable(cast)),
            plateau=self.plateau(cast),
        )

    def needs(self, times: Floats, frames: slice) -> slice:
        """Return the frames of the input that it has to see to say what it asks on some.

        These are the same ones. A kind that looks at others besides says so here, so that a part
        of a clip can be solved without all of it.

        Args:
            times: Seconds, of all frames of the clip.
            frames: Those that are to be solved, a start and a stop.
        """
        return frames

    def span(self, times: Floats) -> slice:
        """Return the frames outside of which it asks for nothing, whatever its activity is."""
        return between(times, self.times)

    def eased(self, cast: Cast) -> Floats:
        """Return its activity with its easing, one number or shape (frame_count,)."""
        return np.asarray(self.activity * ease(cast.times, self.times))

    def node(self, cast: Cast) -> int:
        """Return the node of the effector's joint."""
        return cast.node((self.skeleton, self.joint), self.path)

    def effector(self, cast: Cast) -> Term:
        """Return the effector's point."""
        return Term(self.node(cast), self.point)

    def recruited(self, cast: Cast) -> Iterable[int]:
        """Return the nodes that it may move."""
        if self.recruits:
            return [cast.node((self.skeleton, token), self.path) for token in self.recruits]
        return cast.chain(self.node(cast))

    def movable(self, cast: Cast) -> Iterable[int]:
        """Return every node that can move what it measures, moving goals included."""
        joints = [self.node(cast)]
        joints += [cast.node(goal.joint, self.path) for goal in self.goals if goal.joint]
        return {node for joint in joints for node in cast.ancestors(joint)}

    def plateau(self, cast: Cast) -> Bools:
        """Return the frames where it is fully on, and so is one of its goals if it has any."""
        activity = np.broadcast_to(self.eased(cast), cast.frame_count)
        full = activity >= 1.0 - 1e-9
        on_goal = full & (Shares.of(self.goals, cast.times).blend >= 1.0 - 1e-9)
        return on_goal if on_goal.any() else full
