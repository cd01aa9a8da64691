"""What there is to see of a stage: its scenes with their results, and those nobody solved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say, beside_its_input
from usdmotion.errors import SceneError
from usdmotion.grounding import Told
from usdmotion.outcome import Outcome
from usdmotion.plugins import host
from usdmotion.showing import ShownScene, shown, shown_before

if TYPE_CHECKING:
    from usdmotion.usd import Stage


@dataclass(frozen=True, eq=False)
class Survey:
    """What there is to see of a stage."""

    scenes: tuple[ShownScene, ...]
    """First those that are solved; none on a stage on which nothing is asked."""
    notes: tuple[str, ...]
    """One sentence about each thing that whoever looks should know."""


def survey(
    stage: Stage,
    path: Path,
    *,
    program: str,
    ground: Told | None = None,
    say: Say = lambda _: None,
) -> Survey:
    """Return what there is to see of a stage as it stands.

    Edits that have a result are seen with it, beside the input that it was made from; others as
    they ask, with the motion that they would start from.

    Args:
        stage: The stage.
        path: How to call it in an error.
        program: What a program calls that knows the ground of a result, to be named in an error.
        ground: The ground that a program told when the stage was solved.
        say: Is told what is being done.

    Raises:
        InputError: An edit is at fault, or a result does not fit its edit.
    """
    from usdmotion import usd

    kinds, solved = host().constraints, usd.solved_edits(stage)
    outcomes = usd.outcomes_of(stage, path, kinds, solved) if solved else ()
    say("measuring")
    inputs = [beside_its_input(each, ground, path, program) for each in outcomes]
    scenes = [shown(each) for each in inputs]
    for group in usd.unsolved_edits(stage, solved):
        read = usd.read_stage(stage, path, edits=group, frames=None, cleaning=None, kinds=kinds)
        try:
            scenes += [shown_before(each) for each in read.scenes]
        except SceneError as error:
            raise SceneError(f"{path}: {error}") from error
    notes = (note for each in outcomes for note in _notes(each))
    return Survey(tuple(scenes), tuple(dict.fromkeys(notes)))


def _notes(outcome: Outcome) -> Iterator[str]:
    for record in outcome.records:
        if record.stale:
            yield f"the result of <{record.edit}> is stale: its shot has changed since"
        if not record.shown:
            yield (
                f"the result of <{record.edit}> is not what is shown; its Skeleton is bound to "
                "another animation"
            )
