"""A session: a shot that was read and solved, and is solved again while it is being edited."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Answers, Say, results_of, solved_scenes
from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, altered, sound
from usdmotion.errors import FileError, SceneError
from usdmotion.grounding import PROGRAM, Asked, is_footprint, prims_of, told_by
from usdmotion.motion import Motion
from usdmotion.plugins import host
from usdmotion.report import Report
from usdmotion.scene import Edit, Scene
from usdmotion.solved import SolvedScene

if TYPE_CHECKING:
    from usdmotion.usd import Draft, Draw, Result, Shot


@dataclass(frozen=True, eq=False)
class Change:
    """What a change has done to the answer."""

    skeletons: tuple[str, ...]
    """Paths of the Skeletons that may have other poses."""
    frames: slice
    """The frames on which they may, a start and a stop; the same where nothing has changed."""
    time_codes: Floats
    """Time codes of these frames, shape (count,)."""


class Session:
    """A shot that is open: what is asked of it, and the answer, which follows every change.

    Every change solves again what it reaches and no more. One that is refused by an error leaves
    everything as it was; one is undone by setting the constraint that was there before.
    """

    def __init__(self, shot: Shot, answers: Answers) -> None:
        """Take over what was read and solved; `Session.open` is what reads and solves.

        Args:
            shot: What was read.
            answers: Its scenes, solved, and what was done to the input of edits before.
        """
        self._shot = shot
        self._scenes = answers.scenes
        self._answers = answers

    @classmethod
    def open(
        cls,
        shot: Path,
        *,
        edits: Sequence[str] = (),
        solver: str | None = None,
        options: Mapping[str, object] | None = None,
        frames: tuple[float, float] | None = None,
        cleaning: float | None = None,
        ground: Asked = None,
        mend_recruiting: bool = False,
        say: Say = lambda _: None,
    ) -> Session:
        """Read a stage and solve its edits.

        Args:
            shot: The stage; it is read once, and what is written to it later is not seen.
            edits: Paths of the edits to solve; none solves all.
            solver: Name of the solver; None takes what each edit says.
            options: Options of the solver, on top of those that an edit carries for it.
            frames: First and last time code to solve; None takes what each edit says.
            cleaning: Cutoff of the filter that cleans the input first [Hz], 0 for none; None takes
                what each edit says. What is changed later is asked of the cleaned input too.
            ground: What the input is put on after that: paths of prims, none for no ground; a
                ground, or a function of places and times that returns heights, as `FunctionGround`
                has it. None takes what each edit says. Contacts of feet stay as they are then.
            mend_recruiting: Let constraints recruit what the recruiting rule asks of them.
            say: Is told what is being done.

        Raises:
            InputError: The stage, an edit or an option is at fault.
            PluginError: The solver does not keep its contract.
        """
        from usdmotion import usd

        if not shot.is_file():
            raise FileError(f"{shot}: there is no such file")
        say(f"reading {shot}")
        kinds = host().constraints
        told, named = told_by(ground), prims_of(ground)
        read = usd.read(
            shot, edits=edits, frames=frames, cleaning=cleaning, ground=named, kinds=kinds
        )
        if told is not None:
            read = replace(read, ground=(PROGRAM,))
        answers = solved_scenes(
            read, solver, options or {}, ground=told, mend_recruiting=mend_recruiting, say=say
        )
        return cls(read, answers)

    @property
    def constraints(self) -> tuple[Constraint, ...]:
        """What is asked, in the order of the stage."""
        return tuple(each for solved in self._scenes for each in solved.scene.constraints)

    def constraint(self, path: str) -> Constraint:
        """Return a constraint by the path of its prim, or of one of its goals.

        Raises:
            SceneError: There is none.
        """
        for each in self.constraints:
            if path == each.path or any(path == goal.path for goal in each.goals):
                return each
        paths = ", ".join(f"<{each.path}>" for each in self.constraints)
        raise SceneError(f"<{path}> is no constraint or goal of this session; it has {paths}")

    def change(self, path: str, **fields: object) -> Change:
        """Give a constraint or a goal other values.

        Args:
            path: Path of its prim.
            fields: Values by the names of the fields of its kind, in metres and seconds.

        Raises:
            SceneError: There is no such prim or field, or it cannot have such a value.
        """
        constraint = self.constraint(path)
        count = len(self._holding(constraint.path).scene.times)
        if path == constraint.path:
            return self._replace(path, altered(constraint, count, **fields))
        goals = tuple(
            altered(goal, count, **fields) if goal.path == path else goal
            for goal in constraint.goals
        )
        return self._replace(constraint.path, replace(constraint, goals=goals))

    def set(self, constraint: Constraint) -> Change:
        """Put a constraint in the place of that with its path, or add it to the edit above it.

        Raises:
            SceneError: It is under no edit of this session, or asks for what cannot be.
        """
        count = len(self._holding(constraint.path).scene.times)
        return self._replace(constraint.path, sound(constraint, count))

    def remove(self, path: str) -> Change:
        """Take a constraint away.

        Raises:
            SceneError: There is none with this path.
        """
        return self._replace(self.constraint(path).path, None)

    def motion(self, skeleton: str, frames: slice = slice(None)) -> Motion:
        """Return the motion of a skeleton's joints as it is solved, on some of the frames.

        Raises:
            SceneError: No edit of this session solves it.
        """
        solved = next((each for each in self._scenes if skeleton in _skeletons(each.scene)), None)
        if solved is None:
            known = ", ".join(
                f"<{path}>" for each in self._scenes for path in _skeletons(each.scene)
            )
            raise SceneError(f"<{skeleton}> is not solved in this session; it has {known}")
        return solved.motion(skeleton, frames)

    def report(self) -> Report:
        """Return what is left of every constraint, measured from the answer as it is now."""
        edits = (
            replace(
                edit,
                cleaning=self._answers.cleanings.get(edit.path),
                ground=self._answers.groundings.get(edit.path),
            )
            for solved in self._scenes
            for edit in solved.report().edits
        )
        return Report(tuple(edits), self.notes)

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence about each thing that whoever asked should know."""
        told = (note for solved in self._scenes for note in solved.notes)
        return (*self._shot.warnings, *self._answers.notes, *told)

    def write(self, output: Path, *, compose: Path | None = None, draw: Draw | None = None) -> None:
        """Write the layer that puts the answer over the shot.

        It is the one that `pipeline.solve` writes of a stage on which the constraints are as they
        are here. It does not hold them: `usd.author` does that.

        Args:
            output: The layer to write.
            compose: Where to write a stage that shows the answer over the shot; None writes none.
            draw: Draws what there is to see of it into the layer; None draws nothing.

        Raises:
            FileError: It cannot be written there, or is a layer that was read.
        """
        from usdmotion import usd

        if compose is not None:
            usd.require_composable(self._shot, output, compose)  # before anything is written
        shot = self._asked
        usd.write(shot, self._results, output, notes=self.notes, draw=draw)
        if compose is not None:
            usd.compose(shot, output, compose)

    def draw_up(self, draft: Draft) -> None:
        """Put the answer into a draft, and the draft where it belongs.

        Raises:
            SceneError: It would not be seen there; nothing is changed.
        """
        from usdmotion import usd

        said = usd.put(draft.layer, self._asked, self._results, draft.folder, self.notes)
        draft.put(whole=[take.result for take in self._shot.takes], **said)

    @property
    def inputs(self) -> tuple[Scene, ...]:
        """What was first solved: scenes that are cleaned, and on their grounds."""
        return self._answers.inputs

    @property
    def _asked(self) -> Shot:
        """What was read, with what is asked of it now."""
        # Results are what has changed of what was read, be that cleaned and put on a ground or not.
        pairs = zip(self._shot.scenes, self._scenes, strict=True)
        scenes = tuple(_as_read(solved.scene, read) for read, solved in pairs)
        return replace(self._shot, scenes=scenes)

    @property
    def _results(self) -> list[Result]:
        return [each for solved in self._scenes for each in results_of(solved)]

    def _replace(self, path: str, constraint: Constraint | None) -> Change:
        """Solve with another constraint of a path, with one more, or with one less."""
        solved = self._holding(path)
        self._refuse_footprints(solved.scene, path, constraint)
        scene = _with(solved.scene, path, constraint)
        frames = solved.become(scene)
        return Change(_skeletons(scene), frames, scene.time_codes[frames])

    def _refuse_footprints(self, scene: Scene, path: str, constraint: Constraint | None) -> None:
        """Raise if a change is of a contact that the input was put on the ground by."""
        edit = next(each for each in scene.edits if path.startswith(f"{each.path}/"))
        if edit.path not in self._answers.groundings:
            return
        character = scene.character(edit.skeleton)
        before = (each for each in edit.constraints if each.path == path)
        for each in (*before, constraint):
            if each is not None and is_footprint(each, character):
                raise SceneError(
                    f"<{path}> is a footprint by which <{edit.path}> was put on its ground when "
                    "this session was opened; change it on the stage and open that"
                )

    def _holding(self, path: str) -> SolvedScene:
        """Return the scene with the edit above a path."""
        for solved in self._scenes:
            if any(path.startswith(f"{edit.path}/") for edit in solved.scene.edits):
                return solved
        paths = ", ".join(f"<{each.path}>" for one in self._scenes for each in one.scene.edits)
        raise SceneError(f"<{path}> is under no edit of this session; it has {paths}")


def _with(scene: Scene, path: str, constraint: Constraint | None) -> Scene:
    """Return a scene in which a constraint takes the place of that with its path, if any."""

    def changed(edit: Edit) -> Edit:
        before = edit.constraints
        there = any(each.path == path for each in before)
        if not there and (constraint is None or not path.startswith(f"{edit.path}/")):
            return edit
        after = (constraint if each.path == path else each for each in before)
        added = () if there else (constraint,)
        return replace(
            edit, constraints=tuple(each for each in (*after, *added) if each is not None)
        )

    return replace(scene, edits=tuple(map(changed, scene.edits)))


def _as_read(asked: Scene, read: Scene) -> Scene:
    """Return what is asked of the motions that were read, and of the grounds that were."""
    grounds = {each.path: each.ground for each in read.edits}
    edits = tuple(replace(each, ground=grounds[each.path]) for each in asked.edits)
    return replace(asked, characters=read.characters, edits=edits)


def _skeletons(scene: Scene) -> tuple[str, ...]:
    return tuple(edit.skeleton for edit in scene.edits)
