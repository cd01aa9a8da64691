"""The passes of a solve, kept so that some frames of all of them can be solved again."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter
from typing import ClassVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.changes import hull
from usdmotion.errors import PluginError, SceneError
from usdmotion.motion import Motion
from usdmotion.resuming import Journal, Kept, pose, solve_again
from usdmotion.scene import Edit, Scene
from usdmotion.smoothing import Pass, after_filter, passed, reach, smoothed, winds
from usdmotion.solving import Problem, Solution, Solver


@dataclass
class Checked:
    """A solver whose answers are looked at before anybody uses them."""

    name: ClassVar[str] = "checked"
    solver: Solver
    seconds: float = 0.0
    """How long it has taken."""

    def solve(self, problem: Problem) -> Solution:
        """Return what the solver finds.

        Raises:
            PluginError: It is not a pose of every joint on every frame.
        """
        started = perf_counter()
        solution = self.solver.solve(problem)
        self.seconds += perf_counter() - started
        name, wanted = self.solver.name, problem.cast.rotations.shape[:2]
        found = np.shape(solution.rotations)[:2]
        if found != wanted:
            raise PluginError(f"the solver '{name}' gives back {found}, not {wanted}, poses")
        if not (np.isfinite(solution.translations).all() and np.isfinite(solution.rotations).all()):
            raise PluginError(f"the solver '{name}' gives back numbers that are not finite")
        return solution


@dataclass(frozen=True, eq=False)
class _Stage:
    """One pass, as it can be written to."""

    translations: Floats
    """Where it starts from: the input motion, with what was filtered of the pass before."""
    rotations: Floats
    kept: Kept
    """What it found."""
    filtered: bool
    """Whether a filter comes before it."""

    @classmethod
    def of(cls, done: Pass, filtered: bool) -> "_Stage":
        given = done.given
        kept = Kept.of(done.solution)
        return cls(np.array(given.translations), np.array(given.rotations), kept, filtered)

    def pose(self, scene: Scene, frames: slice) -> Problem:
        """Return the problem that the pass solves on some frames."""
        problem = pose(scene, frames)
        if not self.filtered:
            return problem
        times = problem.cast.times
        return after_filter(
            problem, Motion(times, self.translations[frames], self.rotations[frames])
        )


class Passes:
    """What a scene's passes have found, on all frames.

    With a filter between them a pass reaches as many frames more as the filter is wide. Where that
    cannot be told, because the frames are uneven or a displacement winds, it is all of them.
    """

    def __init__(self, scene: Scene, solver: Solver) -> None:
        """Solve all frames of a scene.

        Raises:
            SceneError: The scene is at fault.
            PluginError: The solver does not keep its contract.
        """
        self._cutoff, count = passes_of(scene.edits)
        self._solver = Checked(solver)
        problem = Problem.of(scene)
        self._times = problem.cast.times
        done = passed(self._solver, problem, self._cutoff, count)
        self._stages = [_Stage.of(each, number > 0) for number, each in enumerate(done)]
        first = self._stages[0]
        self._winds = len(self._stages) > 1 and winds(self._input(), self._found(first))

    @property
    def last(self) -> Kept:
        """What the last pass has found."""
        return self._stages[-1].kept

    @property
    def solution(self) -> Solution:
        """A copy of it; iterations are those of all passes together."""
        *before, last = (each.kept.during(slice(None)) for each in self._stages)
        return replace(last, iterations=sum((each.iterations for each in before), last.iterations))

    @property
    def seconds(self) -> float:
        """How long the solver has taken, all that was solved again together."""
        return self._solver.seconds

    def solve_again(self, scene: Scene, frames: slice, *, levels_kept: bool) -> slice:
        """Solve some frames of a scene, and what they reach.

        Args:
            scene: What is asked now.
            frames: Those on which something else is asked; none is allowed.
            levels_kept: Whether each level has the constraints that it had. Where not, what a frame
                has handed on beside its pose means nothing any more.

        Returns:
            The frames that may have another pose.

        Raises:
            SceneError: The scene is at fault; what was found before stands.
            PluginError: The solver does not keep its contract; likewise.
        """
        journal, carried = Journal(), [each.kept.carried for each in self._stages]
        if not levels_kept:
            for stage in self._stages:
                stage.kept.carried = None
        try:
            return (
                self._solve_again(scene, frames, journal) if frames.start < frames.stop else frames
            )
        except BaseException:
            journal.take_back()
            for stage, before in zip(self._stages, carried, strict=True):
                stage.kept.carried = before
            raise

    def _solve_again(self, scene: Scene, asked: slice, journal: Journal) -> slice:
        frames = asked
        for number, stage in enumerate(self._stages):
            if number:
                before = self._stages[number - 1]
                frames = hull([asked, self._filter(before, stage, frames, journal)])
            found = solve_again(self._solver, partial(stage.pose, scene), stage.kept, frames)
            first = frames.start
            for each in found:
                stage.kept.write(first, each, journal)
                first += len(each.stops)
            frames = slice(frames.start, first)
        return frames

    def _filter(self, before: _Stage, stage: _Stage, frames: slice, journal: Journal) -> slice:
        """Filter what a pass has changed for the next one; return which frames start elsewhere."""
        width = reach(self._times, self._cutoff)
        wide = self._around(frames, width)
        seen = self._around(wide, width)
        self._winds |= winds(self._input(seen), self._found(before, seen))
        if self._winds:
            wide = seen = slice(0, len(self._times))
        start = smoothed(self._input(seen), self._found(before, seen), self._cutoff)
        inside = slice(wide.start - seen.start, wide.stop - seen.start)
        journal.write(stage.translations, wide, start.translations[inside])
        journal.write(stage.rotations, wide, start.rotations[inside])
        return wide

    def _input(self, frames: slice = slice(None)) -> Motion:
        first = self._stages[0]
        return Motion(self._times[frames], first.translations[frames], first.rotations[frames])

    def _found(self, stage: _Stage, frames: slice = slice(None)) -> Motion:
        kept = stage.kept
        return Motion(self._times[frames], kept.translations[frames], kept.rotations[frames])

    def _around(self, frames: slice, width: int) -> slice:
        return slice(max(frames.start - width, 0), min(frames.stop + width, len(self._times)))


def passes_of(edits: Sequence[Edit]) -> tuple[float, int]:
    """Return the cutoff [Hz] and the number of passes that the edits of a scene share.

    Raises:
        SceneError: They do not.
    """
    first = edits[0]
    for edit in edits:
        if (edit.smoothing, edit.passes) != (first.smoothing, first.passes):
            raise SceneError(
                f"<{first.path}> and <{edit.path}> are solved together but ask for different "
                "usdmotion:smoothing or usdmotion:passes; make them equal"
            )
    return first.smoothing, first.passes
