"""Guides of a stage, from file to file, or on a stage that is open."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say
from usdmotion.errors import SceneError
from usdmotion.grounding import Told
from usdmotion.plugins import host
from usdmotion.report.guides import EditGuides, GuidesReport, ObjectGuides
from usdmotion.scene import Scene
from usdmotion.showing import ShownEdit
from usdmotion.surveying import survey

if TYPE_CHECKING:
    from usdmotion.guides import ContactMark
    from usdmotion.usd import Draw, Overlay, Stage

_NOTHING = (
    "there is nothing to draw, neither an edit that asks for something nor a contact; add "
    "constraints to a MotionEdit, or run `usdmotion detect` first"
)


def guides(
    result: Path,
    output: Path,
    *,
    shot: Path | None = None,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> GuidesReport:
    """Draw what there is to see of a stage, in a layer over it.

    Edits are drawn with their results where there are some, else as they ask; and so is every
    contact. Everything has the purpose guide.

    Args:
        result: A stage, or a layer of results.
        output: The layer to write; what it is drawn over are its sublayers.
        shot: The shot under a layer of results; None finds it as `usd.read_outcomes` says.
        ground: The ground that a program told when it was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.

    Returns:
        What was drawn.

    Raises:
        InputError: The stage is at fault, has nothing to draw, or the layer cannot be written.
    """
    from usdmotion import usd

    say(f"reading {result}")
    *between, beneath = usd.files_of(result, shot=shot, kinds=host().constraints)
    overlay = usd.Overlay.open(beneath, output, between=between)
    drawn = guides_over(overlay.stage, result, ground=ground, inputs=inputs, say=say)
    say(f"writing {output}")
    overlay.write()
    return drawn


def guides_over(
    stage: Stage,
    path: Path,
    *,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> GuidesReport:
    """Draw what there is to see of a stage that is open, in its edit target.

    Args:
        stage: The stage.
        path: How to call it in an error.
        ground: The ground that a program told when it was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.

    Returns:
        What was drawn.

    Raises:
        InputError: The stage is at fault, or has nothing to draw.
    """
    from usdmotion import usd

    seen = survey(
        stage, path, program="usdmotion.guiding.guides", ground=ground, inputs=inputs, say=say
    )
    edits = tuple(_told(edit) for scene in seen.scenes for edit in scene.edits)
    say("drawing")
    try:
        contacts = usd.read_contact_marks(stage)
        if not edits and not contacts:
            raise SceneError(seen.faults[0] if seen.faults else _NOTHING)
        usd.author_guides(stage, seen.scenes, contacts)
        usd.author_contact_marks(stage, contacts)
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    return GuidesReport(edits, _objects(contacts), seen.notes)


def guides_for(
    wanted: bool | Path,
    path: Path,
    *,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> Draw | None:
    """Return what draws guides into a layer that is being made; None where none are wanted there.

    Args:
        wanted: Whether they are wanted, or the file in which they are wanted instead.
        path: How to call the stage in an error.
        ground: The ground that a program told when it was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.
    """
    if wanted is not True:
        return None
    return lambda stage: guides_over(stage, path, ground=ground, inputs=inputs, say=say)


def guides_beside(
    wanted: bool | Path,
    result: Path,
    *,
    shot: Path | None = None,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> None:
    """Draw what there is to see of a layer that was written, where a file is wanted for it.

    Args:
        wanted: Whether guides are wanted, or the file in which they are.
        result: The layer, or a stage.
        shot: The shot under it, where it has none as its sublayer.
        ground: The ground that a program told when it was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.

    Raises:
        InputError: The file cannot be written.
    """
    if isinstance(wanted, Path):
        guides(result, wanted, shot=shot, ground=ground, inputs=inputs, say=say)


def write_with_guides(
    overlay: Overlay,
    wanted: bool | Path,
    *,
    inputs: Sequence[Scene] = (),
    say: Say = lambda _: None,
) -> None:
    """Write a layer, and guides where they are wanted.

    Args:
        overlay: The layer, with all else in it.
        wanted: Whether guides are wanted in it, or the file in which they are wanted instead.
        inputs: What `Answers` has of the solve whose results are in it, where it is at hand.
        say: Is told what is being done.

    Raises:
        InputError: The layer or the file cannot be written.
    """
    if wanted is True:
        guides_over(overlay.stage, overlay.shot, inputs=inputs, say=say)
    say(f"writing {overlay.output}")
    overlay.write()
    guides_beside(wanted, overlay.output, inputs=inputs, say=say)


def require_room(wanted: bool | Path, layers: Sequence[Path | None], shots: Sequence[Path]) -> None:
    """Raise if a file of guides would take the place of something else, or has no place.

    Args:
        wanted: Whether guides are wanted, or the file in which they are.
        layers: What else is written; None is nothing.
        shots: The stages that are read.

    Raises:
        FileError: It would, or a stage cannot be opened.
    """
    from usdmotion import usd

    if isinstance(wanted, Path):
        usd.require_apart((*layers, wanted), ())
        usd.require_unread(wanted, shots)


def _told(edit: ShownEdit) -> EditGuides:
    return EditGuides(
        path=edit.path,
        solved=edit.solved,
        trajectories=len(edit.courses),
        goals=len(edit.goals),
        missed=tuple(miss.name for miss in edit.misses),
        balance=edit.balance is not None,
    )


def _objects(contacts: Sequence[ContactMark]) -> tuple[ObjectGuides, ...]:
    counted = Counter(each.object for each in contacts)
    return tuple(ObjectGuides(name, count) for name, count in counted.items())
