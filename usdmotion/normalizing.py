"""Motions are taken off their bodies, with what they must obey, from file to file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say
from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.plugins import host
from usdmotion.report.normalizing import NormalizedReport, NormalizingReport, travellers_of
from usdmotion.searching import search_over

if TYPE_CHECKING:
    from usdmotion.usd import Overlay
    from usdmotion.usd.normalized import Recorded, Subject


@dataclass(frozen=True)
class Choice:
    """Which motion of a shot is meant."""

    source: str = ""
    """Path of a Skeleton, a SkelAnimation or a MotionNormalized; "" takes what there is."""
    edits: tuple[str, ...] = ()
    """Paths of the MotionEdits that say what motions must obey."""
    frames: tuple[float, float] | None = None
    """First and last time code; None is all of the motion."""
    contacts: bool = True
    """Whether contacts of feet are looked for where there are none."""


def normalize(
    shot: Path,
    output: Path,
    *,
    source: str = "",
    edits: Sequence[str] = (),
    frames: tuple[float, float] | None = None,
    contacts: bool = True,
    say: Say = lambda _: None,
) -> NormalizingReport:
    """Take motions off their bodies, and write a stage of normalized motions.

    What edits ask of a motion travels along, in lengths of legs and parts of bodies.

    Args:
        shot: The stage.
        output: The layer to write; it has one MotionNormalized for each human body that moves.
        source: Path of the only Skeleton, or SkelAnimation, that is of interest.
        edits: Paths of the MotionEdits whose constraints travel; where a Skeleton has only one, or
            one whose result is bound, nobody needs to say.
        frames: First and last time code; None takes all of a motion.
        contacts: Look for contacts of feet where there are none.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault, or no body is human.
        PluginError: A detector does not keep its contract.
    """
    from usdmotion import usd

    say(f"reading {shot}")
    overlay = usd.Overlay.open(shot, output)
    choice = Choice(source, tuple(edits), frames, contacts)
    recorded, notes = take_off(overlay, choice, say=say)
    say(f"writing {output}")
    rate = overlay.stage.GetTimeCodesPerSecond()
    usd.write_normalized([each.luggage for each in recorded], output, rate=rate, notes=notes)
    return NormalizingReport(tuple(map(told, recorded)), notes)


def take_off(
    overlay: Overlay, choice: Choice, *, say: Say = lambda _: None
) -> tuple[list[Recorded], tuple[str, ...]]:
    """Return the motions of a shot without their bodies, and what should be known of it.

    Of several skeletons those that are no human bodies are left out with a note.

    Args:
        overlay: A layer over the shot, into which contacts are put that are found on the way; it
            need not be written.
        choice: Which motions.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault, or no body is human.
        PluginError: A detector does not keep its contract.
    """
    from usdmotion.usd import normalized

    found: list[Recorded] = []
    notes: list[str] = []
    refused: list[SceneError] = []
    try:
        for each in normalized.find_subjects(overlay.stage, choice.source, choice.edits):
            name = _free(normalized.name_of(each), [one.luggage.name for one in found])
            say(f"normalizing {each.path}")
            try:
                recorded, said = _take_off(overlay, each, name, choice, say)
            except SceneError as error:
                refused.append(error)
            else:
                found.append(recorded)
                notes += [*said, *normalized.notes_of(recorded.subject)]
        if not found:
            raise refused[0]
    except SceneError as error:
        named = str(error).startswith(f"{overlay.shot}: ")
        raise error if named else SceneError(f"{overlay.shot}: {error}") from error
    notes += [f"one is left out: {error}" for error in refused]
    return found, tuple(dict.fromkeys(notes))


def told(recorded: Recorded) -> NormalizedReport:
    """Return what there is to tell of a motion that was taken off its body."""
    luggage = recorded.luggage
    motion = luggage.motion
    return NormalizedReport(
        path=f"/{luggage.name}",
        skeleton=recorded.subject.path,
        source=luggage.source,
        frames=len(motion.times),
        seconds=float(motion.times[-1]),
        leg=recorded.body.leg_length,
        parts=tuple(part for part in recorded.body.parts.parts if part),
        extra_joints=motion.extra_joints,
        carriers=motion.carriers,
        travellers=travellers_of(luggage.travellers, luggage.left, luggage.found),
    )


def _take_off(
    overlay: Overlay, subject: Subject, name: str, choice: Choice, say: Say
) -> tuple[Recorded, list[str]]:
    """Return a motion, and notes of the search for contacts where there were none of its feet."""
    from usdmotion.usd import normalized

    stage, kinds = overlay.stage, host().constraints
    recorded = normalized.read_recorded(stage, subject, name, choice.frames, kinds)
    if recorded.contacts or not choice.contacts:
        return recorded, []
    detections, notes = _look(overlay, recorded, say)
    again = normalized.in_edit_of(stage, subject, detections)
    read = normalized.read_recorded(stage, again, name, choice.frames, kinds, detections)
    return read, [*notes, *_found(read)]


def _look(
    overlay: Overlay, recorded: Recorded, say: Say
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Look for contacts of feet, and of knees and hands that come down to the ground.

    Returns:
        The paths of their detections, and notes.
    """
    from usdmotion import usd
    from usdmotion.usd import normalized
    from usdmotion.usd.stages import read_facts

    subject = recorded.subject
    edit = "" if subject.edit is None else str(subject.edit.GetPath())
    joints = normalized.feet_of(recorded.body)
    detections = usd.author_feet(overlay.stage, joints, edit=edit)
    looked = search_over(overlay, Asked(joints=joints, edit=edit, guides=False), say=say)
    up = read_facts(overlay.stage).up
    asked_for = {each.constraint.joint for each in recorded.luggage.travellers}
    low = normalized.low_joints(recorded.character, recorded.body, up, asked_for)
    if not low:
        return detections, looked.notes
    others = usd.author_feet(overlay.stage, low, edit=edit)
    asked = Asked(joints=low, edit=edit, guides=False)
    again = search_over(overlay, asked, say=say)
    return (*detections, *others), (*looked.notes, *again.notes)


def _found(recorded: Recorded) -> Iterator[str]:
    count = len(recorded.luggage.found)
    travel = "travels" if count == 1 else "travel"
    yield f"<{recorded.subject.path}> has no contacts of its feet; " + (
        f"{count} that its motion shows {travel} along, so that its feet stand on other bodies"
        if count
        else "its motion shows none either, so that nothing holds its feet on other bodies"
    )


def _free(name: str, taken: list[str]) -> str:
    number, found = 1, name
    while found in taken:
        number += 1
        found = f"{name}{number}"
    return found
