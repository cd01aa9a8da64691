"""The verbs on a stage that is open: what they make goes to its edit target, and not to disk.

The stage may have changes that nobody has saved, and layers that are in memory only. Each verb
makes all of what it makes first and writes it in one change, or raises and changes nothing.
Importing it makes USD know the schema, so do it before opening the stage.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from usdmotion import usd
from usdmotion.answering import Say, beside_its_input, solved_scenes
from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.guiding import guides_over
from usdmotion.outcome import Outcome
from usdmotion.plugins import host
from usdmotion.report import Report
from usdmotion.report.contacts import DetectionReport
from usdmotion.report.findings import Findings, findings_of
from usdmotion.report.guides import GuidesReport
from usdmotion.reporting import require_matplotlib, tell
from usdmotion.searching import search_stage
from usdmotion.session import Session
from usdmotion.usd import Inspection, Stage

_Made = TypeVar("_Made")


@dataclass(frozen=True)
class Worst:
    """Where the result of a constraint is furthest from what is asked."""

    path: str
    """Path of the constraint."""
    time_code: float
    """When its error is largest, of the times at which it is judged."""
    error: float
    """In `unit`."""
    unit: str
    """`m` or `deg`."""
    tolerance: float
    """What counts as met, in `unit`."""
    met: bool
    """Whether the error is within it."""


def inspect(stage: Stage) -> Inspection:
    """Return what is on a stage: skeletons, clips, edits, constraints, and every fault found."""
    return usd.inspect_stage(stage, usd.name_of(stage), host().constraints)


def detect(
    stage: Stage, asked: Asked | None = None, *, say: Say = lambda _: None
) -> DetectionReport:
    """Look for contacts, and put them into the edit target.

    What is not asked for is left to the MotionDetections of the stage. Where there are none, the
    ankles and balls of all known feet are looked at.

    Args:
        stage: The stage.
        asked: What to look at, and for what; None leaves all of it to the stage.
        say: Is told what is being done.

    Raises:
        InputError: The stage, its edit target, or what is asked for, is at fault.
        PluginError: A detector does not keep its contract.
    """
    draft = usd.Draft(stage)
    report, told = search_stage(draft.stage, usd.name_of(stage), asked or Asked(), say=say)
    draft.put(detection=told)
    return report


def solve(stage: Stage, edits: Sequence[str] = (), *, say: Say = lambda _: None) -> Report:
    """Solve edits, and bind their results in the edit target.

    Args:
        stage: The stage.
        edits: Paths of the edits to solve; none solves all.
        say: Is told what is being done.

    Raises:
        InputError: The stage, its edit target, or an edit is at fault.
        PluginError: A solver does not keep its contract.
    """
    draft = usd.Draft(stage)
    read = usd.read_stage(
        stage,
        usd.name_of(stage),
        edits=edits,
        frames=None,
        cleaning=None,
        kinds=host().constraints,
    )
    session = Session(read, solved_scenes(read, say=say))
    session.draw_up(draft)
    return session.report()


def shown(stage: Stage, edit: str) -> bool:
    """Tell whether a Skeleton is bound to the result of an edit, or to what was made from it.

    Raises:
        SceneError: There is no such edit.
    """
    return _named(stage, lambda: usd.is_shown(stage, edit))


def show(stage: Stage, edits: str | Sequence[str], on: bool) -> None:
    """Bind the results of edits, or what they were made from, in the edit target.

    Where the result of another edit is stacked on one, that one is shown, or hidden as well.

    Args:
        stage: The stage.
        edits: Path of the MotionEdit, or paths of several.
        on: Whether their results are to be shown.

    Raises:
        SceneError: There is no such edit, it has no result, or the edit target is at fault.
    """
    draft = usd.Draft(stage)
    for edit in _several(edits):
        # Of edits that are stacked each finds what the one before it was bound to.
        _named(stage, partial(usd.author_shown, draft.layer, draft.stage, edit, on))
    draft.put()


def worst(stage: Stage, constraint: str) -> Worst:
    """Return where the result of a constraint, as it stands, is furthest from what is asked.

    Args:
        stage: The stage.
        constraint: Path of the constraint, or of a prim below it.

    Raises:
        SceneError: It has no result, or is never fully on.
    """
    outcomes = _outcomes(stage, constraint)
    return _named(stage, lambda: _worst(outcomes, constraint))


def add_position_constraint(
    stage: Stage, skeleton: str, joint: str, *, time_code: float, space: str = ""
) -> str:
    """Make a position constraint with one goal, around a time, in the edit target.

    It goes into the edit of the Skeleton, which is made where there is none. It ranks below what is
    there, which may keep it from being met, and recruits what that lets it. It can be solved as it
    is: its goal follows a prim, or is an offset to the motion, of nothing until somebody moves it.

    Args:
        stage: The stage.
        skeleton: Path of the Skeleton, or of the MotionEdit of one that it is to go into.
        joint: The joint, as a token, leaf name or H-Anim name.
        time_code: The middle of the second for which it is on.
        space: Path of the prim that the goal follows; "" offsets the motion.

    Returns:
        Path of the constraint. Its goal is the prim `Goal` below it.

    Raises:
        SceneError: What is named is not there, or the edit target is at fault.
    """
    draft = usd.Draft(stage)
    path = _named(
        stage,
        lambda: usd.author_reach(draft.stage, skeleton, joint, time_code=time_code, space=space),
    )
    draft.put()
    return path


def make_template(stage: Stage, contacts: str | Sequence[str]) -> None:
    """Make contacts examples, from which the next detection learns, in the edit target.

    Args:
        stage: The stage.
        contacts: Path of the MotionContactConstraint, or of a prim below it, or several of these.

    Raises:
        SceneError: One is no contact of a detection, or the edit target is at fault.
    """
    draft = usd.Draft(stage)
    for contact in _several(contacts):
        _named(stage, partial(usd.author_template, draft.layer, stage, contact))
    draft.put()


def guides(stage: Stage, *, say: Say = lambda _: None) -> GuidesReport:
    """Draw what there is to see of a stage in its edit target, in the place of what was drawn.

    Args:
        stage: The stage.
        say: Is told what is being done.

    Returns:
        What was drawn.

    Raises:
        InputError: The stage, or its edit target, is at fault, or there is nothing to draw.
    """
    with usd.drawn_on(stage):
        return guides_over(stage, usd.name_of(stage), say=say)


def report(stage: Stage, output: Path, *, say: Say = lambda _: None) -> tuple[Findings, ...]:
    """Write the report of the results on a stage, as `reporting.report` does of files.

    Args:
        stage: The stage.
        output: The file of HTML.
        say: Is told what is being done.

    Returns:
        What it tells, scene by scene.

    Raises:
        InputError: There is no result, the report cannot be written, or matplotlib is missing.
    """
    usd.require_apart((), (output,))
    require_matplotlib()
    say("reading the stage")
    return tell(_outcomes(stage), usd.name_of(stage).name, output, say=say)


def _worst(outcomes: Sequence[Outcome], constraint: str) -> Worst:
    """Return the worst time of a constraint, which is itself or above a prim that is named."""
    traces = (
        trace
        for outcome in outcomes
        for edit in findings_of(outcome).edits
        for trace in edit.traces
    )
    for trace in traces:
        found = trace.verdict
        if f"{constraint}/".startswith(f"{found.path}/"):
            if found.worst_time is None:
                raise SceneError(f"<{found.path}> is never fully on, so that nothing judges it")
            left = (found.max, found.unit, trace.tolerance, found.met)
            return Worst(found.path, found.worst_time, *left)
    raise SceneError(
        f"<{constraint}> is no constraint of an edit that has a result; solve it first"
    )


def _outcomes(stage: Stage, path: str = "") -> list[Outcome]:
    """Return what became of the edits of a stage, beside the input that they started from.

    Where a prim is named, it is of those only that are solved together with the edit above it.
    """
    name, call = usd.name_of(stage), "usdmotion.reporting.report"
    solved = usd.solved_edits(stage)
    if not solved:
        raise SceneError(f"{name}: there is no result of a MotionEdit; solve it first")
    read = usd.outcomes_of(stage, name, host().constraints, solved)
    return [beside_its_input(each, None, name, call) for each in read if _holds(each, path)]


def _holds(outcome: Outcome, path: str) -> bool:
    return not path or any(f"{path}/".startswith(f"{edit.path}/") for edit in outcome.scene.edits)


def _several(paths: str | Sequence[str]) -> Sequence[str]:
    return (paths,) if isinstance(paths, str) else paths


def _named(stage: Stage, made: Callable[[], _Made]) -> _Made:
    """Return what is made of a stage; errors name it."""
    try:
        return made()
    except SceneError as error:
        raise SceneError(f"{usd.name_of(stage)}: {error}") from error
