"""A shot that was read is answered: its scenes are solved, and have results to be written."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion import kernels
from usdmotion.cleaning import Cleaning, cleaned
from usdmotion.detecting import Detected, Search
from usdmotion.errors import FileError, SceneError
from usdmotion.grounding import Detect, Grounding, Told, grounded, standing_on
from usdmotion.kernels.compiling import cache_folder
from usdmotion.options import configured
from usdmotion.options import options as options_of
from usdmotion.outcome import Outcome
from usdmotion.passes import Checked
from usdmotion.plugins import host
from usdmotion.scene import Edit, Scene
from usdmotion.solved import SolvedScene
from usdmotion.solving import Solver

if TYPE_CHECKING:
    from usdmotion.usd import Result, Shot

DEFAULT_DETECTOR = "contacts"
"""What finds the feet that stand, where an edit has a ground and no contacts."""
Say = Callable[[str], None]
"""Is told what is being done now, in a few words."""


@dataclass(frozen=True, eq=False)
class Answers:
    """The scenes of a shot, solved, and what was done to the input of edits first, by paths."""

    scenes: tuple[SolvedScene, ...]
    inputs: tuple[Scene, ...]
    """What each was before it was solved: cleaned, and on its ground."""
    cleanings: Mapping[str, Cleaning]
    groundings: Mapping[str, Grounding]

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence about each thing that was done to an input."""
        cleaned_first = (each.sentence(path) for path, each in self.cleanings.items())
        put = (each.sentence(path) for path, each in self.groundings.items())
        return (*cleaned_first, *put)


def solved_scenes(
    shot: Shot,
    solver: str | None = None,
    options: Mapping[str, object] | None = None,
    *,
    ground: Told | None = None,
    mend_recruiting: bool = False,
    say: Say = lambda _: None,
) -> Answers:
    """Return the scenes of a shot, solved.

    Args:
        shot: What was read.
        solver: Name of the solver; None takes what each edit says.
        options: Options of the solver, on top of those that an edit carries for it.
        ground: A ground that is no prim, for all edits; None takes what each has.
        mend_recruiting: Let constraints recruit what the recruiting rule asks of them.
        say: Is told what is being done.

    Raises:
        InputError: An edit or an option is at fault.
        PluginError: The solver does not keep its contract.
    """
    scenes: list[SolvedScene] = []
    inputs: list[Scene] = []
    cleanings: dict[str, Cleaning] = {}
    groundings: dict[str, Grounding] = {}
    for scene in shot.scenes:
        chosen = _configured(scene.edits, solver, options or {})
        slow = not _is_compiled(chosen)
        say("compiling the solver, once: up to 10 s" if slow else f"solving {_names(scene)}")
        clean, told = cleaned(scene, Checked(chosen).solve)
        cleanings |= told
        stood = grounded(standing_on(clean, ground), feet_detector())
        groundings |= stood.accounts
        inputs.append(stood.posed(stood.scene))
        scenes.append(
            SolvedScene(stood.scene, chosen, mend_recruiting=mend_recruiting, on_ground=stood.posed)
        )
    return Answers(tuple(scenes), tuple(inputs), cleanings, groundings)


def feet_detector() -> Detect:
    """Return what finds contacts of feet as `clean` does, and is looked for when it is needed."""

    def detect(search: Search) -> Detected:
        kind = host().detector(DEFAULT_DETECTOR)
        # A foot that is only setting down or rolling off does not stand yet, or no more.
        known = any(each.name == "rounds" for each in options_of(kind))
        return configured(kind, {"rounds": 1} if known else {}).detect(search)

    return detect


def results_of(solved: SolvedScene) -> Iterable[Result]:
    """Yield what was made of each edit of a scene."""
    from usdmotion.usd import Result

    chosen = solved.solver
    settings = {each.name: getattr(chosen, each.name) for each in options_of(type(chosen))}
    for edit in solved.scene.edits:
        yield Result(edit.path, solved.motion(edit.skeleton), chosen.name, settings)


def beside_its_input(
    outcome: Outcome,
    told: Told | None,
    path: Path,
    program: str,
    inputs: Sequence[Scene] = (),
) -> Outcome:
    """Return an outcome beside the input that its edits started from, and what was solved.

    That was cleaned, or put on the ground, where they ask for it.

    Args:
        outcome: What was read.
        told: The ground that a program told when it was solved.
        path: How to call the stage in an error.
        program: What a program calls that knows the ground.
        inputs: What `Answers` has of the solve that the results are of, where that is at hand.

    Raises:
        FileError: Its ground was told by a program, and nobody tells it now.
    """
    if outcome.told and told is None:
        raise FileError(
            f"{path}: its motion was put on a ground that a program told, so that only a program "
            f"can tell what became of it; call {program} with that ground"
        )
    edits = [edit.path for edit in outcome.scene.edits]
    # What has changed since has another input.
    fresh = not any(record.stale for record in outcome.records)
    for known in inputs:
        if fresh and [edit.path for edit in known.edits] == edits:
            return replace(outcome, scene=known)
    scene = standing_on(outcome.scene, told if outcome.told else None)
    if any(edit.cleaning > 0.0 for edit in scene.edits):
        record = outcome.records[0]
        solver = configured(host().solver(record.solver), record.options)
        scene, _ = cleaned(scene, Checked(solver).solve)
    stood = grounded(scene, feet_detector())
    return replace(outcome, scene=stood.posed(stood.scene))


def _configured(edits: Sequence[Edit], solver: str | None, options: Mapping[str, object]) -> Solver:
    """Return the one solver of a scene with its options."""
    name = solver or edits[0].solver
    # What an edit carries are options of the solver that it names, and of no other.
    carried = {edit.path: dict(edit.options) if edit.solver == name else {} for edit in edits}
    first = edits[0]
    for edit in edits:
        if (solver is None and edit.solver != name) or carried[edit.path] != carried[first.path]:
            raise SceneError(
                f"<{first.path}> and <{edit.path}> are solved together but ask for different "
                "solvers or options; make them equal, or name one of them with --edit"
            )
    return configured(host().solver(name), carried[first.path] | dict(options))


def _is_compiled(solver: Solver) -> bool:
    """Tell whether compiled code of a solver's kernels is on disk."""
    module = sys.modules[type(solver).__module__]
    folders = [Path(str(each.__file__)).parent for each in (kernels, module)]
    return any(cache_folder(*folders).rglob("*.nbi"))


def _names(scene: Scene) -> str:
    return ", ".join(edit.path for edit in scene.edits)
