"""What there is to see of a stage: its scenes with their results, and those nobody solved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say, beside_its_input
from usdmotion.errors import SceneError
from usdmotion.grounding import Told
from usdmotion.outcome import Outcome
from usdmotion.plugins import host
from usdmotion.scene import Scene
from usdmotion.showing import ShownScene, shown, shown_before

if TYPE_CHECKING:
    from usdmotion.usd import Stage


@dataclass(frozen=True, eq=False)
class Survey:
    """What there is to see of a stage."""

    scenes: tuple[ShownScene, ...]
    """First those that are solved; none on a stage on which nothing is asked."""
    faults: tuple[str, ...]
    """Why an edit that nobody solved is not seen, one sentence each."""
    notes: tuple[str, ...]
    """One sentence about each thing that whoever looks should know, faults included."""


def survey(
    stage: Stage,
    path: Path,
    *,
    program: str,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> Survey:
    """Return what there is to see of a stage as it stands.

    Edits that have a result are seen with it, beside the input that it was made from; others as
    they ask, with the motion that they would start from. One of these that is at fault is left out.

    Args:
        stage: The stage.
        path: How to call it in an error.
        program: What a program calls that knows the ground of a result, to be named in an error.
        ground: The ground that a program told when the stage was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.

    Raises:
        InputError: An edit that is solved is at fault, or its result does not fit it.
    """
    from usdmotion import usd

    kinds, solved = host().constraints, usd.solved_edits(stage)
    outcomes = usd.outcomes_of(stage, path, kinds, solved) if solved else ()
    say("measuring")
    beside = (beside_its_input(each, ground, path, program, inputs) for each in outcomes)
    scenes = [shown(each) for each in beside]
    faults: list[str] = []
    for group in usd.unsolved_edits(stage, solved):
        asked, wrong = _asked(stage, path, group)
        scenes += asked
        faults += wrong
    told = (note for each in outcomes for note in _notes(each))
    return Survey(tuple(scenes), tuple(faults), tuple(dict.fromkeys((*told, *faults))))


def _asked(stage: Stage, path: Path, edits: Sequence[str]) -> tuple[list[ShownScene], list[str]]:
    """Return what some edits ask, and what is wrong with those that cannot be read."""
    from usdmotion import usd

    kinds = host().constraints
    try:
        read = usd.read_stage(stage, path, edits=edits, frames=None, cleaning=None, kinds=kinds)
        return [shown_before(each) for each in read.scenes], []
    except SceneError as error:
        if len(edits) == 1:
            reason = str(error).removeprefix(f"{path}: ")
            return [], [f"what <{edits[0]}> asks is not seen: {reason}"]
    alone = [_asked(stage, path, [each]) for each in edits]
    return [one for scenes, _ in alone for one in scenes], [
        one for _, all_ in alone for one in all_
    ]


def _notes(outcome: Outcome) -> Iterator[str]:
    for record in outcome.records:
        if record.stale:
            yield f"the result of <{record.edit}> is stale: its shot has changed since"
        if not record.shown:
            yield (
                f"the result of <{record.edit}> is not what is shown; its Skeleton is bound to "
                "another animation"
            )
