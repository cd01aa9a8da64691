"""The centre of mass stays over its supports as it was, or goes where it is wanted."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints.attributes import attribute
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import Shares, composite_point, trajectory
from usdmotion.errors import SceneError
from usdmotion.tasks import PointTask, Term


@dataclass(frozen=True, eq=False, kw_only=True)
class CenterOfMassConstraint(Constraint):
    """Balance control of 2004, section 4.3: P'_com = mean(A') + P_com − mean(A) + displacement.

    A are the support points in the input, A' in the output, so that the target moves while feet are
    being solved. Without supports the centre of mass keeps its own trajectory.
    """

    schema: ClassVar[str] = "MotionCenterOfMassConstraint"
    weighs: ClassVar[bool] = True
    supports: tuple[str, ...] = attribute(())
    """Joints that carry the support points; none: its own trajectory."""
    support_points: Floats = attribute(lambda: np.zeros((0, 3)), unit="length", frame="supports")
    """Those points in their joints' frames [m], shape (support_count, 3); none: the origins."""
    displacement: Floats = attribute(
        lambda: np.zeros(3), unit="length", frame="edit", animated=True
    )
    """Where it is to be from there [m], in the world, shape (3,) or (frame_count, 3)."""
    axes: str = attribute("xyz", frame="goals")
    """The axes of the goal's space along which it is held."""

    def tasks(self, cast: Cast) -> Iterator[PointTask]:
        """Yield one point task: the body's mass points, less what the supports carry along."""
        body, supports = self._body(cast), self._supports(cast)
        original = trajectory(cast, body) - trajectory(cast, supports) + self.displacement
        task = composite_point(cast, self.goals, body, original, self.axes, self.path)
        # A goal in a place of its own does not move with the supports, the others do.
        shares = Shares.of(self.goals, cast.times).weights
        placed = [w for goal, w in zip(self.goals, shares, strict=True) if goal.mode != "offset"]
        carried = 1.0 - np.sum(placed, axis=0)
        less = tuple(replace(each, coefficient=-each.coefficient * carried) for each in supports)
        yield replace(task, terms=task.terms + less)

    def recruited(self, cast: Cast) -> Iterable[int]:
        """Return the nodes that it may move: all joints of its skeleton, if it names none."""
        return super().recruited(cast) if self.recruits else self._joints(cast)

    def movable(self, cast: Cast) -> Iterable[int]:
        """Return every joint of its skeleton, and what can move its goals."""
        goals = [cast.node(goal.joint, self.path) for goal in self.goals if goal.joint]
        above = {node for joint in goals for node in cast.ancestors(joint)}
        return above | set(self._joints(cast))

    def _joints(self, cast: Cast) -> list[int]:
        return [
            node
            for node, (path, token) in enumerate(cast.joints)
            if path == self.skeleton and token
        ]

    def _body(self, cast: Cast) -> tuple[Term, ...]:
        """Return the mass of every joint as a point, its share of the whole as the factor."""
        joints = [node for node in self._joints(cast) if cast.masses[node] > 0.0]
        if not joints:
            raise SceneError(
                f"<{self.path}> is about a body without masses; author usdmotion:masses on "
                f"<{self.skeleton}>"
            )
        total = cast.masses[joints].sum()
        return tuple(
            Term(node, cast.mass_centers[node], cast.masses[node] / total) for node in joints
        )

    def _supports(self, cast: Cast) -> tuple[Term, ...]:
        count = len(self.supports)
        points = self.support_points if len(self.support_points) else np.zeros((count, 3))
        if len(points) != count:
            raise SceneError(
                f"<{self.path}> has {count} supports and {len(points)} points of them; give one "
                "point for each, or none"
            )
        nodes = [cast.node((self.skeleton, token), self.path) for token in self.supports]
        pairs = zip(nodes, points, strict=True)
        return tuple(Term(node, point, 1.0 / count) for node, point in pairs)
