"""What a solver reads: every task of a problem in one table of plain arrays.

T tasks in rank order over F frames and N nodes; K terms and G orientation goals, each belonging to
one task. A node is a joint of the cast, or a skeleton's space.
"""

from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Bools, Floats, Ints


class Kind(IntEnum):
    """The primitive kinds of tasks; from ROTATION on their errors are angles."""

    POINT = 0
    """Σ coefficient · point of the terms is at the target [m]."""
    DISTANCE = 1
    """Σ coefficient · point of the terms, less the target, is so far from a shape about 0 [m]."""
    ROTATION = 2
    """The first term's node, turned by the offset, has the orientation asked for [rad]."""
    AIM = 3
    """The free axis of the first term's node points from the sum to the target [rad]."""


class Shape(IntEnum):
    """What the distance of a DISTANCE task is from; inside a shape it is negative."""

    BOX = 0
    """A cuboid; without extent along an axis a plate, a segment, a point."""
    CYLINDER = 1
    """About its z axis."""
    HALF_SPACE = 2
    """Below its z = 0."""


class TaskTable(NamedTuple):
    """One row a task; the meaning of each column is the same for every solver."""

    kind: Ints
    """(T,) a `Kind`."""
    level: Ints
    """(T,) 0 is enforced first; ascending."""
    constraint: Ints
    """(T,) index of the constraint that the task belongs to."""
    weight: Floats
    """(F, T) share of the squared error inside a level."""
    activity: Floats
    """(F, T) 0 absent, 1 asked for, between: let go to what is there without it."""
    recruits: Bools
    """(T, N) the nodes that the task may move."""
    axes: Bools
    """(T, 3) the axes along which a point is held."""
    axes_node: Ints
    """(T,) node in whose frame the axes are, -1 for the world."""
    axes_rotation: Floats
    """(F, T, 4) orientation of the axes, or of the shape, in that frame."""
    first_term: Ints
    """(T + 1,) the terms of task t are first_term[t] to first_term[t + 1]."""
    term_node: Ints
    """(K,) the node that a point is fixed to."""
    term_point: Floats
    """(F, K, 3) the point in the node's frame [m]."""
    term_coefficient: Floats
    """(F, K) its factor in the sum."""
    target: Floats
    """(F, T, 3) what the sum of the terms should be, or is seen from [m]."""
    shape: Ints
    """(T,) a `Shape`."""
    extent: Floats
    """(F, T, 3) half its size along its axes, a cylinder's radius first; may be infinite [m]."""
    distance: Floats
    """(F, T) how far a DISTANCE task is to be from it [m]."""
    bound: Ints
    """(T,) 0 exactly so far, 1 at least, −1 at most: those ask for nothing until touched."""
    offset: Floats
    """(T, 4) rotation in the node's frame, applied before it is compared."""
    free_axis: Floats
    """(T, 3) axis of the node's frame about which turning is free, and the one that aims; zero for
    none."""
    first_goal: Ints
    """(T + 1,) the goals of a ROTATION task t are first_goal[t] to first_goal[t + 1]."""
    goal_node: Ints
    """(G,) node in whose frame a goal is, -1 for the world."""
    goal_rotation: Floats
    """(F, G, 4) orientation in that frame."""
    goal_weight: Floats
    """(F, G) its part in the mean of the goals."""
    original: Floats
    """(F, T, 4) orientation that is kept where no goal is active."""
    blend: Floats
    """(F, T) 0 the original, 1 the mean of the goals."""

    def during(self, frames: slice) -> "TaskTable":
        """Return the table of some of the frames; nothing is copied."""
        return self._replace(**{name: getattr(self, name)[frames] for name in OVER_FRAMES})

    def above(self, lower: "TaskTable") -> "TaskTable":
        """Return this table, which has a task, with those of another on levels below its own."""
        counted = {"level": 1 + self.level[-1], "constraint": 1 + self.constraint.max()}

        def column(name: str) -> NDArray[Any]:
            upper, under = getattr(self, name), getattr(lower, name)
            if name.startswith("first_"):
                return np.concatenate([upper, upper[-1] + under[1:]])
            under = under + counted[name] if name in counted else under
            return np.concatenate([upper, under], axis=int(name in OVER_FRAMES))

        return TaskTable(**{name: column(name) for name in self._fields})


OVER_FRAMES = (
    "weight",
    "activity",
    "axes_rotation",
    "term_point",
    "term_coefficient",
    "target",
    "extent",
    "distance",
    "goal_rotation",
    "goal_weight",
    "original",
    "blend",
)
"""The columns that have a value for each frame; all others hold for the whole clip."""
