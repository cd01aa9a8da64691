"""The verbs, as functions: what the command line does, without a word printed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from usdmotion import kernels
from usdmotion.errors import FileError, InputError, PluginError, SceneError
from usdmotion.kernels.compiling import cache_folder
from usdmotion.mending import broken, mended, sentence
from usdmotion.motion import Motion
from usdmotion.options import configured
from usdmotion.options import options as options_of
from usdmotion.plugins import host
from usdmotion.recording import Recording
from usdmotion.report import ConstraintReport, EditReport, Report, judge
from usdmotion.resampling import evenly
from usdmotion.scene import Edit, Scene
from usdmotion.smoothing import enforced
from usdmotion.solving import STOPS, Problem, Solution, Solver

if TYPE_CHECKING:
    from usdmotion.usd import Inspection, Result

Say = Callable[[str], None]
"""Is told what is being done now, in a few words."""


def import_motion(
    source: Path,
    output: Path,
    *,
    fps: float | None = None,
    first: float = 1.0,
    unit: float | None = None,
    name: str | None = None,
    reader: str | None = None,
    options: Mapping[str, object] | None = None,
) -> Recording:
    """Make a stage of a file of motion.

    Args:
        source: The file, in any format that a reader plugin knows.
        output: The layer to write.
        fps: Samples per second of the stage; None keeps the file's.
        first: Time code of the first sample.
        unit: Metres per unit of the file; None lets the reader decide.
        name: Name of the character; None takes the reader's.
        reader: Name of the reader; None takes the first that reads files of this ending.
        options: Options of the reader.

    Returns:
        What was written, with notes about what was decided on the way.

    Raises:
        InputError: The file is refused, or nothing reads it.
    """
    from usdmotion import usd

    _require(source)
    kind = host().reader(reader) if reader else host().reader_of(source)
    settings = dict(options or {}) | ({} if unit is None else {"unit": unit})
    recording = configured(kind, settings).read(source)
    if name is not None:
        if not name.isidentifier():
            raise InputError(f"the name '{name}' is no prim name; use letters, digits and '_'")
        recording = replace(recording, name=name)
    if fps is not None:
        recording = replace(recording, motion=evenly(recording.motion, fps), frame_rate=fps)
    usd.write_recording(recording, output, frame_rate=fps, first=first)
    return recording


def inspect(shot: Path) -> Inspection:
    """Return what is on a stage: skeletons, clips, edits, constraints, and every fault found.

    Raises:
        FileError: It cannot be opened.
    """
    from usdmotion import usd

    _require(shot)
    return usd.inspect(shot, host().constraints)


def solve(
    shot: Path,
    output: Path,
    *,
    edits: Sequence[str] = (),
    solver: str | None = None,
    options: Mapping[str, object] | None = None,
    frames: tuple[float, float] | None = None,
    compose: Path | None = None,
    mend_recruiting: bool = False,
    say: Say = lambda _: None,
) -> Report:
    """Solve the edits of a stage and write the layer that puts the answer over it.

    Args:
        shot: The stage.
        output: The layer to write.
        edits: Paths of the edits to solve; none solves all.
        solver: Name of the solver; None takes what each edit says.
        options: Options of the solver, on top of those that an edit carries for it.
        frames: First and last time code to solve; None takes what each edit says.
        compose: Where to write a stage that shows the answer over the shot; None writes none.
        mend_recruiting: Let constraints recruit what the recruiting rule asks of them.
        say: Is told what is being done.

    Raises:
        InputError: The stage, an edit or an option is at fault.
        PluginError: The solver does not keep its contract.
    """
    from usdmotion import usd

    _require(shot)
    say(f"reading {shot}")
    read = usd.read(shot, edits=edits, frames=frames, kinds=host().constraints)
    solved = []
    for scene in read.scenes:
        scene = mended(scene) if mend_recruiting else scene
        solved.append(_solve_scene(scene, solver, options or {}, say))
    say(f"writing {output}")
    usd.write(read, [result for each in solved for result in each.results], output)
    if compose is not None:
        usd.compose(read, output, compose)
    return Report(
        tuple(edit for each in solved for edit in each.edits),
        (*read.warnings, *(note for each in solved for note in each.notes)),
    )


@dataclass(frozen=True)
class _Solved:
    """One scene, solved: parallel to its edits."""

    edits: tuple[EditReport, ...]
    results: tuple[Result, ...]
    notes: tuple[str, ...]


def _solve_scene(
    scene: Scene, solver: str | None, options: Mapping[str, object], say: Say
) -> _Solved:
    from usdmotion.usd import Result

    chosen = _configured(scene.edits, solver, options)
    problem = Problem.of(scene)
    names = ", ".join(edit.path for edit in scene.edits)
    say(f"solving {names}" if _is_compiled(chosen) else "compiling the solver, once: up to 10 s")
    started = perf_counter()
    cutoff, passes = _passes(scene.edits)
    solution = enforced(chosen, problem, cutoff=cutoff, passes=passes)
    seconds = perf_counter() - started
    _check(chosen, problem, solution)
    rows = dict(zip(scene.constraints, judge(scene, problem, solution), strict=True))
    frames, iterations = problem.cast.frame_count, int(solution.iterations.sum())
    settings = {each.name: getattr(chosen, each.name) for each in options_of(type(chosen))}

    def report(edit: Edit) -> EditReport:
        own: Iterable[ConstraintReport] = (rows[each] for each in edit.constraints)
        facts = (edit.path, edit.skeleton, chosen.name, frames, seconds, iterations)
        return EditReport(*facts, tuple(own))

    def result(edit: Edit) -> Result:
        motion = _motion(scene, edit.skeleton, solution)
        return Result(edit.path, motion, chosen.name, settings)

    notes = (*scene.notes, *_unsettled(names, solution), *map(sentence, broken(scene)))
    return _Solved(tuple(map(report, scene.edits)), tuple(map(result, scene.edits)), tuple(notes))


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


def _unsettled(names: str, solution: Solution) -> Iterable[str]:
    """Yield what there is to say where a solve was left before it came to rest."""
    frames = int((solution.stops == STOPS.index("iteration limit")).sum())
    if frames:
        yield (
            f"{names}: {frames} of {len(solution.stops)} frames were left at the iteration limit, "
            "still moving"
        )


def _passes(edits: Sequence[Edit]) -> tuple[float, int]:
    """Return the cutoff and the passes of a scene, which its edits share."""
    first = edits[0]
    for edit in edits:
        if (edit.smoothing, edit.passes) != (first.smoothing, first.passes):
            raise SceneError(
                f"<{first.path}> and <{edit.path}> are solved together but ask for different "
                "usdmotion:smoothing or usdmotion:passes; make them equal"
            )
    return first.smoothing, first.passes


def _check(solver: Solver, problem: Problem, solution: Solution) -> None:
    wanted = problem.cast.rotations.shape[:2]
    found = np.shape(solution.rotations)[:2]
    if found != wanted:
        raise PluginError(f"the solver '{solver.name}' gives back {found}, not {wanted}, poses")
    if not (np.isfinite(solution.translations).all() and np.isfinite(solution.rotations).all()):
        raise PluginError(f"the solver '{solver.name}' gives back numbers that are not finite")


def _motion(scene: Scene, skeleton: str, solution: Solution) -> Motion:
    """Return the motion of one skeleton's joints, which stand after its space."""
    cast = scene.cast
    start = cast.index[(skeleton, "")] + 1
    joints = slice(start, start + len(scene.character(skeleton).skeleton.joints))
    return Motion(cast.times, solution.translations[:, joints], solution.rotations[:, joints])


def _is_compiled(solver: Solver) -> bool:
    """Tell whether compiled code of a solver's kernels is on disk."""
    module = sys.modules[type(solver).__module__]
    folders = [Path(str(each.__file__)).parent for each in (kernels, module)]
    return any(cache_folder(*folders).rglob("*.nbi"))


def _require(path: Path) -> None:
    if not path.is_file():
        raise FileError(f"{path}: there is no such file")
