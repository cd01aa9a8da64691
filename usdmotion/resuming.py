"""Solving some frames of a scene again, until the new solution has met the old one.

What a frame becomes is decided by what is asked on it and by what its solve is handed from the
frame before: the displacement of the pose from the input, and what `Solution.carried` says. So a
solve that goes on from a frame that was kept finds, to the last bit, what a solve of the whole clip
would. Behind the frames that ask for something else both solves ask for the same and draw the
posture to the same input, so that what they hand on becomes the same, in reaching four times nearer
from frame to frame, until neither moves any more. Where the difference is below `MET` they have
met, and what follows stands.

How far that is from a solve of the whole clip: by MET at first, and no more later on, because what
stands are answers to what is asked still, and frames draw such answers together. That holds after
any number of changes: each of them finds its frames anew, and lets nothing stand that is further
off than MET where it meets it. A tenth of a micrometre, and of a part of a quaternion, is what
single precision rounds off when it is written. Where so little decides how often a frame iterates,
it grows for once to what a settled frame may be off by anyway, and falls again.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Floats, Ints
from usdmotion.changes import hull
from usdmotion.scene import Scene
from usdmotion.solving import Problem, Solution, Solver

MET = 1e-7
"""Largest difference of two poses that have met: of positions [m], of parts of quaternions.

Well above the last digit of a task, which solvers take for none."""
_PIECE = 1024
"""Most frames whose problem is posed at a time."""
_AHEAD = 16
"""How many frames are posed at a time where it is not known how many will be solved."""

_COLUMNS = ("translations", "rotations", "iterations", "stops")

Pose = Callable[[slice], Problem]
"""Returns the problem of some of the frames."""


def pose(scene: Scene, frames: slice) -> Problem:
    """Return the problem of some frames of a scene; the others are not looked at.

    Raises:
        SceneError: A constraint asks for what cannot be.
    """
    seen = hull(each.needs(scene.times, frames) for each in scene.constraints)
    seen = hull([seen, frames])
    part = Problem.of(scene.during(seen))
    return part.during(slice(frames.start - seen.start, frames.stop - seen.start))


@dataclass(eq=False)
class Kept:
    """A solution that can be written to."""

    translations: Floats
    rotations: Floats
    iterations: Ints
    stops: Ints
    carried: Floats | None

    @classmethod
    def of(cls, solution: Solution) -> "Kept":
        """Return a copy of a solution; what it carries is taken over."""
        poses = np.array(solution.translations), np.array(solution.rotations)
        return cls(
            *poses, np.array(solution.iterations), np.array(solution.stops), solution.carried
        )

    @property
    def frame_count(self) -> int:
        """Number of frames."""
        return len(self.stops)

    def during(self, frames: slice) -> Solution:
        """Return a copy of some of the frames."""
        carried = None if self.carried is None else np.array(self.carried[frames])
        poses = self.translations[frames], self.rotations[frames]
        return Solution(*poses, self.iterations[frames], self.stops[frames], carried)

    def write(self, first: int, solution: Solution, journal: "Journal") -> None:
        """Replace the frames from the first one on."""
        frames = slice(first, first + len(solution.stops))
        for name in _COLUMNS:
            journal.write(getattr(self, name), frames, getattr(solution, name))
        if solution.carried is None:
            return
        shape = solution.carried.shape[1:]
        if self.carried is None or self.carried.shape[1:] != shape:
            self.carried = np.zeros((self.frame_count, *shape))
        journal.write(self.carried, frames, solution.carried)


class Journal:
    """Writes into arrays so that it can be taken back."""

    def __init__(self) -> None:
        self._before: list[tuple[NDArray[Any], slice, NDArray[Any]]] = []

    def write(self, array: NDArray[Any], frames: slice, values: NDArray[Any]) -> None:
        """Replace some frames of an array."""
        self._before.append((array, frames, np.array(array[frames])))
        array[frames] = values

    def take_back(self) -> None:
        """Make every array what it was."""
        for array, frames, values in reversed(self._before):
            array[frames] = values


def solve_again(solver: Solver, pose: Pose, kept: Kept, frames: slice) -> list[Solution]:
    """Solve some frames, and those behind them until the solution meets the one that is kept.

    Args:
        solver: One that resumes.
        pose: What is asked now.
        kept: The solution of what was asked before; it is not changed.
        frames: Where the two may differ.

    Returns:
        What was found, in order and without a gap, from the first of the frames on.
    """
    known = kept.during(slice(frames.start - 1, frames.start)) if frames.start else None
    found: list[Solution] = []
    for piece, problem in _pieces(pose, frames, kept.frame_count):
        solution = solver.solve(replace(problem, known=known))
        new = solution.during(slice(piece.start and 1, None))
        if piece.start >= frames.stop and met(new, kept.during(piece)):
            break
        found.append(new)
        known = new.during(slice(-1, None))
    return found


def met(one: Solution, other: Solution) -> bool:
    """Tell whether two solutions of some frames have the same poses, and hand on the same."""
    turned = np.minimum(
        np.abs(one.rotations - other.rotations).max(axis=-1),
        np.abs(one.rotations + other.rotations).max(axis=-1),
    )
    moved = np.abs(one.translations - other.translations)
    if max(turned.max(), moved.max()) > MET:
        return False
    if one.carried is None or other.carried is None or one.carried.shape != other.carried.shape:
        return True
    both = (one.carried != 0.0) & (other.carried != 0.0)
    return bool(np.abs(one.carried - other.carried)[both].max(initial=0.0) <= MET)


def _pieces(pose: Pose, frames: slice, count: int) -> Iterator[tuple[slice, Problem]]:
    """Yield what to solve bit by bit, each with the frame before it as the first of its problem."""
    for start in range(frames.start, frames.stop, _PIECE):
        stop, before = min(start + _PIECE, frames.stop), max(start - 1, 0)
        ahead = _AHEAD if stop == frames.stop else 0
        seen = min(stop + ahead, count)
        window = pose(slice(before, seen))
        yield slice(start, stop), window.during(slice(0, stop - before))
        yield from _frame_by_frame(window, before, slice(stop, seen))
    for start in range(frames.stop + _AHEAD, count, _AHEAD):
        stop = min(start + _AHEAD, count)
        window = pose(slice(start - 1, stop))
        yield from _frame_by_frame(window, start - 1, slice(start, stop))


def _frame_by_frame(window: Problem, first: int, frames: slice) -> Iterator[tuple[slice, Problem]]:
    """Yield each of some frames of a problem that begins with a frame before them."""
    for frame in range(frames.start, frames.stop):
        inside = slice(frame - 1 - first, frame + 1 - first)
        yield slice(frame, frame + 1), window.during(inside)
