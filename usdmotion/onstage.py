"""The verbs on a stage that is open: what they make goes to its edit target, and not to disk.

The stage may have changes that nobody has saved, and layers that are in memory only. Each verb
makes all of what it makes first and writes it in one change, or raises and changes nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from usdmotion.answering import Say, solved_scenes
from usdmotion.asking import Asked
from usdmotion.plugins import host
from usdmotion.report import Report
from usdmotion.report.contacts import DetectionReport
from usdmotion.searching import search_stage
from usdmotion.session import Session

if TYPE_CHECKING:
    from usdmotion.usd import Inspection, Stage


def inspect(stage: Stage) -> Inspection:
    """Return what is on a stage: skeletons, clips, edits, constraints, and every fault found."""
    from usdmotion import usd

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
    from usdmotion import usd

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
    from usdmotion import usd

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
