"""The contract between a scene and whatever solves it."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints, seal
from usdmotion.cast import Cast
from usdmotion.kernels import TaskTable
from usdmotion.scene import Scene
from usdmotion.tasks import tabulate

STOPS = ("not solved", "settled", "iteration limit")
"""Why a frame was left, by the numbers in `Solution.stops`."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What a solver is given; fields may be added, never taken away."""

    cast: Cast
    """Who takes part, and the input motion."""
    table: TaskTable
    """What is asked, in rank order."""

    @classmethod
    def of(cls, scene: Scene) -> "Problem":
        """Return the problem that a scene poses."""
        cast = scene.cast
        return cls(cast, tabulate(scene.demands, cast.frame_count, cast.node_count))

    @cached_property
    def recruited(self) -> Bools:
        """Which nodes any task may move, shape (node_count,)."""
        return np.asarray(self.table.recruits.any(axis=0), dtype=np.bool_)


@dataclass(frozen=True, eq=False)
class Solution:
    """What a solver gives back; the host measures by itself what is left of every constraint."""

    translations: Floats
    """Position of each node in its parent's frame [m], shape (frame_count, node_count, 3)."""
    rotations: Floats
    """Orientation in the parent's frame, unit xyzw, shape (frame_count, node_count, 4)."""
    iterations: Ints
    """Iterations spent on each frame, shape (frame_count,)."""
    stops: Ints
    """Why each frame was left: an index into `STOPS`, shape (frame_count,)."""

    def __post_init__(self) -> None:
        shape = np.shape(self.rotations)[:2]
        for name, size in (("translations", 3), ("rotations", 4)):
            array = seal(getattr(self, name), *shape, size, name=name)
            object.__setattr__(self, name, array)
        for name in ("iterations", "stops"):
            array = seal(getattr(self, name), shape[0], dtype=np.int64, name=name)
            object.__setattr__(self, name, array)


@runtime_checkable
class Solver(Protocol):
    """Solves a whole clip. Its dataclass fields made by `option` are its options."""

    name: ClassVar[str]

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks as their ranks say.

        Nodes that no active task recruits keep the input; a target out of reach is no error.
        """
        ...
