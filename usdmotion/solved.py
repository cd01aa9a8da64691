"""A scene with its solution, which goes along with every change of its constraints."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from usdmotion import limits
from usdmotion.changes import changed, same_levels
from usdmotion.constraints import Constraint
from usdmotion.mending import broken, mended, sentence
from usdmotion.motion import Motion
from usdmotion.passes import Passes
from usdmotion.report import EditReport, Report, judge
from usdmotion.resuming import Kept
from usdmotion.scene import Edit, Scene
from usdmotion.solving import STOPS, Problem, Solution, Solver, resumes


class SolvedScene:
    """A scene that is solved, and solved again where its constraints change.

    What a change costs grows with the frames that it reaches and not with the clip, if the solver
    resumes; else all frames are solved again.

    Attributes:
        scene: What is asked.
        posed: What is solved: the same, with contacts of feet on their ground, and with recruiting
            mended where that was wished.
        solver: What solves it.
    """

    def __init__(
        self,
        scene: Scene,
        solver: Solver,
        *,
        mend_recruiting: bool = False,
        on_ground: Callable[[Scene], Scene] = lambda scene: scene,
    ) -> None:
        """Solve a scene.

        Args:
            scene: What is asked.
            solver: With its options.
            mend_recruiting: Let constraints recruit what the recruiting rule asks of them.
            on_ground: Puts the contacts of feet on the ground that their characters stand on.

        Raises:
            SceneError: The scene is at fault.
            PluginError: The solver does not keep its contract.
        """
        self.scene = scene
        self._mend = mend_recruiting
        self._on_ground = on_ground
        self.posed = mended(on_ground(scene)) if mend_recruiting else on_ground(scene)
        self.solver = solver
        self._passes = Passes(self.posed, solver)
        self._before = 0.0

    @property
    def seconds(self) -> float:
        """How long the solver has taken, all changes together."""
        return self._before + self._passes.seconds

    @property
    def solution(self) -> Solution:
        """A copy of the solution of all frames; iterations are those of all passes together."""
        return self._passes.solution

    def motion(self, skeleton: str, frames: slice = slice(None)) -> Motion:
        """Return the motion of one skeleton's joints as they are solved, on some of the frames."""
        joints = self.scene.nodes(skeleton)
        kept = self._passes.last
        poses = kept.translations[frames, joints], kept.rotations[frames, joints]
        return Motion(self.scene.times[frames], *poses)

    def become(self, scene: Scene) -> slice:
        """Solve the scene as it is now asked.

        Args:
            scene: The same characters at the same times, with other constraints.

        Returns:
            The frames that may have another pose; the others have the one that they had, to the
            last bit.

        Raises:
            SceneError: The scene is at fault. It stays what it was, and so does the solution.
            PluginError: The solver does not keep its contract; likewise.
        """
        posed = self._posed(scene)
        frames = changed(self.posed, posed)
        if resumes(self.solver):
            levels_kept = same_levels(self.posed, posed)
            frames = self._passes.solve_again(posed, frames, levels_kept=levels_kept)
        elif frames.start < frames.stop:
            passes = Passes(posed, self.solver)
            frames = _apart(self._passes.last, passes.last)
            self._before += self._passes.seconds
            self._passes = passes
        self.scene, self.posed = scene, posed
        return frames

    def report(self) -> Report:
        """Return what is left of every constraint, measured from the solution."""
        scene, solution = self.posed, self.solution
        rows = dict(zip(scene.constraints, judge(scene, Problem.of(scene), solution), strict=True))
        spent = len(solution.stops), self.seconds, int(solution.iterations.sum())

        def told(edit: Edit) -> EditReport:
            own = tuple(rows[each] for each in edit.constraints)
            return EditReport(edit.path, edit.skeleton, self.solver.name, *spent, own)

        return Report(tuple(map(told, scene.edits)), self.notes)

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence about each thing in the scene or its solution that should be known."""
        scene = self.posed
        solution, names = self.solution, _names(scene)
        beyond = limits.sentences(scene, solution, self.solver.name)
        return (
            *scene.notes,
            *_unsettled(scene, solution),
            *(f"{names}: {each}" for each in beyond),
            *map(sentence, broken(scene)),
        )

    def _posed(self, scene: Scene) -> Scene:
        """Return what is solved; constraints that stay what they were stay the same objects."""
        grounded = self._on_ground(scene)
        if not self._mend:
            return grounded
        before = zip(self.scene.constraints, self.posed.constraints, strict=True)
        known = {id(asked): posed for asked, posed in before}
        fresh = iter(mended(grounded).constraints)

        def kept(asked: Constraint) -> Constraint:
            new, old = next(fresh), known.get(id(asked))
            return old if old is not None and old.recruits == new.recruits else new

        edits = (
            replace(edit, constraints=tuple(map(kept, edit.constraints))) for edit in scene.edits
        )
        return replace(scene, edits=tuple(edits))


def _unsettled(scene: Scene, solution: Solution) -> Iterator[str]:
    """Yield what there is to say where a solve was left before it came to rest."""
    frames = int((solution.stops == STOPS.index("iteration limit")).sum())
    if frames:
        yield (
            f"{_names(scene)}: {frames} of {len(solution.stops)} frames were left at the iteration "
            "limit, still moving"
        )


def _names(scene: Scene) -> str:
    return ", ".join(edit.path for edit in scene.edits)


def _apart(one: Kept, other: Kept) -> slice:
    """Return the frames from the first to the last on which two solutions have other poses."""
    moved = (one.translations != other.translations).any(axis=(1, 2))
    turned = (one.rotations != other.rotations).any(axis=(1, 2))
    frames = np.flatnonzero(moved | turned)
    return slice(int(frames[0]), int(frames[-1]) + 1) if len(frames) else slice(0, 0)
