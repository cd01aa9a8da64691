"""The contract between a scene and whatever solves it."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints, seal
from usdmotion.cast import Cast
from usdmotion.kernels import OVER_FRAMES, TaskTable
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
    known: "Solution | None" = None
    """What was found on the first frames, at least one, which are not to be solved; None solves
    all. Only a solver that resumes is given it."""
    moved: Bools | None = None
    """Which nodes constraints may move on any frame of the clip that this is a part of, shape
    (node_count,); None: those of the table."""

    @classmethod
    def of(cls, scene: Scene) -> "Problem":
        """Return the problem that a scene poses."""
        cast = scene.cast
        table = tabulate(scene.demands, cast.frame_count, cast.node_count)
        return cls(cast, table, moved=scene.recruited)

    def during(self, frames: slice, known: "Solution | None" = None) -> "Problem":
        """Return what is asked on some of the frames, the first of which may be known."""
        return replace(
            self, cast=self.cast.during(frames), table=self.table.during(frames), known=known
        )

    @cached_property
    def recruited(self) -> Bools:
        """Which nodes may be moved on any frame of the clip, shape (node_count,)."""
        if self.moved is not None:
            return self.moved
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
    carried: Floats | None = None
    """What a solver that resumes hands from a frame to the next beside the pose, zeros where that
    is nothing, shape (frame_count, …); what it means is the solver's own."""

    def __post_init__(self) -> None:
        shape = np.shape(self.rotations)[:2]
        for name, size in (("translations", 3), ("rotations", 4)):
            array = seal(getattr(self, name), *shape, size, name=name)
            object.__setattr__(self, name, array)
        for name in ("iterations", "stops"):
            array = seal(getattr(self, name), shape[0], dtype=np.int64, name=name)
            object.__setattr__(self, name, array)

    def during(self, frames: slice) -> "Solution":
        """Return the solution on some of its frames."""
        carried = None if self.carried is None else self.carried[frames]
        poses = (self.translations[frames], self.rotations[frames])
        return Solution(*poses, self.iterations[frames], self.stops[frames], carried)


@runtime_checkable
class Solver(Protocol):
    """Solves a whole clip. Its dataclass fields made by `option` are its options.

    One that can go on from where a solve was left says so by a class attribute, `resumes = True`:
    given a problem of which the first frames are known, it gives back these as they are, and on
    the others what it would have found had it solved all of them, to the last bit.
    """

    name: ClassVar[str]

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks as their ranks say.

        Nodes that no active task recruits keep the input, but for limits of joints, which a solver
        may keep on every frame of those that any task recruits; the host says where it does not.
        A target out of reach is no error.
        """
        ...


class Pose(NamedTuple):
    """The transforms of all nodes on one frame."""

    translations: Floats
    """Position in the parent's frame [m], shape (node_count, 3)."""
    rotations: Floats
    """Orientation in the parent's frame, unit xyzw, shape (node_count, 4)."""


class Performance(Protocol):
    """A solve that goes on frame by frame, forward only, while what is asked changes.

    Write what comes into `table` and `input`, and step; `output` is the answer. All three stay the
    same arrays from frame to frame, are nobody else's, and a step allocates no others. What is not
    written stays as it was on the frame before; at the start it is the problem's first frame.
    """

    @property
    def table(self) -> TaskTable:
        """What is asked of the coming frame: one frame of the problem's table, to be written to.

        Targets, weights and activities may change, as may every other column of `OVER_FRAMES`.
        Which tasks there are, whom they move and in which order they rank stays as it was.
        """
        ...

    @property
    def input(self) -> Pose:
        """Where the input motion is on the coming frame, to be written to."""
        ...

    @property
    def output(self) -> Pose:
        """The solved pose of the frame that was stepped to last, to be read."""
        ...

    def step(self) -> None:
        """Solve the coming frame.

        A target in the frame of another character's joint is where that joint is now: characters
        that look at each other are solved one after the other on the same frame.
        """
        ...


@runtime_checkable
class Live(Solver, Protocol):
    """A solver that can also be stepped: a door for games, and for who drags a goal (2005).

    Its options hold for its performances as well. One that is called `threads`, how many may work
    at a time, changes nothing about the answer.
    """

    def start(self, problem: Problem) -> Performance:
        """Return a performance whose first step is the first frame of a problem.

        Stepped through all frames of the problem, with its table and its input, it gives what
        `solve` gives, to the last bit. Of later frames it is not to know anything.
        """
        ...


def cue(performance: Performance, problem: Problem, frame: int) -> None:
    """Write what a problem asks on one of its frames, and its input there, into a performance."""
    for name in OVER_FRAMES:
        np.copyto(getattr(performance.table, name)[0], getattr(problem.table, name)[frame])
    np.copyto(performance.input.translations, problem.cast.translations[frame])
    np.copyto(performance.input.rotations, problem.cast.rotations[frame])


def resumes(solver: Solver) -> bool:
    """Tell whether a solver can go on from frames that are known."""
    return bool(getattr(solver, "resumes", False))
