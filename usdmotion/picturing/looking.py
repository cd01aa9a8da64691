"""Looking at a stage: which frames, from where, and what there is to be seen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.arrays import Floats
from usdmotion.asking import Span
from usdmotion.errors import InputError, SceneError
from usdmotion.grounding import Told
from usdmotion.guides import ContactMark
from usdmotion.picturing.frames import asked_for, usual
from usdmotion.picturing.moments import tiers_of
from usdmotion.picturing.scenery import Scenery, look
from usdmotion.picturing.views import USUAL, require_askable
from usdmotion.plugins import host
from usdmotion.showing import ShownScene
from usdmotion.showing.telling import Clip, telling
from usdmotion.surveying import Survey, survey

if TYPE_CHECKING:
    from usdmotion.usd.seeing import Side


@dataclass(frozen=True, eq=False)
class Looked:
    """All that a strip is made of."""

    sceneries: tuple[Scenery, ...]
    """One, or before and after."""
    codes: Floats
    """Time codes of the columns, ascending."""
    scenes: tuple[ShownScene, ...]
    """What is asked, met and missed."""
    camera: str
    """Path of the camera; "" takes the views."""
    views: tuple[str, ...]
    notes: tuple[str, ...]
    """One sentence about each thing that whoever looks should know."""


def look_at(
    stage: Path,
    *,
    shot: Path | None = None,
    frames: Span | Sequence[float] | None = None,
    views: Sequence[str] = (),
    camera: str = "",
    compare: Path | None = None,
    ground: Told | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Looked:
    """Return all that a strip is made of, as `picture` draws it.

    Args:
        stage: The stage, or a layer of results.
        shot: The shot under the layer; None finds it beside it, as `usd.files_of` says.
        frames: Which frames; None takes about six at which it is worth looking.
        views: Some of front, side, top, three-quarter; none takes the last, or the camera.
        camera: Path of the camera to look through.
        compare: A layer that goes over the shot, or a stage, to be seen as what it is after.
        ground: The ground that a program told when the stage was solved.
        say: Is told what is being done.

    Raises:
        InputError: The stage cannot be read, what is asked for is not there, or nothing is seen.
    """
    from usdmotion import usd
    from usdmotion.usd.seeing import sides_of

    require_askable(views, camera)
    say(f"reading {stage}")
    sides = sides_of(usd.files_of(stage, shot=shot, kinds=host().constraints), compare)
    _require_camera(sides, camera)
    found, contacts = _asked(sides[-1], ground, say), [_contacts(side) for side in sides]
    codes = _codes(sides, tiers_of(found.scenes, contacts[-1][0]), frames)
    say("looking")
    looks = [look(side, codes, own) for side, (own, _) in zip(sides, contacts, strict=True)]
    sceneries = tuple(scenery for scenery, _ in looks)
    notes = (
        *found.notes,
        *_strangers(sides),
        *(note for _, told in (*contacts, *looks) for note in told),
    )
    _require_something(stage, sceneries, codes)
    return Looked(
        sceneries=sceneries,
        codes=codes,
        scenes=found.scenes,
        camera=camera,
        views=() if camera else tuple(views) or (USUAL,),
        notes=tuple(dict.fromkeys(notes)),
    )


def _asked(side: Side, ground: Told | None, say: Callable[[str], None]) -> Survey:
    """Return what is asked on a stage, met and missed; nothing and why, where that is at fault.

    Whoever looks for the reason may need a picture.
    """
    program = "usdmotion.picturing.picture"
    try:
        return survey(side.stage, side.path, program=program, ground=ground, say=say)
    except InputError as error:
        fault = f"what is asked is not drawn: {error}"
        return Survey((), (fault,), (fault,))


def _contacts(side: Side) -> tuple[tuple[ContactMark, ...], tuple[str, ...]]:
    """Return the contacts on a stage; none and a note on it, where one is at fault."""
    from usdmotion.usd import read_contact_marks

    try:
        return read_contact_marks(side.stage), ()
    except SceneError as error:
        return (), (f"contacts are not drawn: {side.path}: {error}",)


def _strangers(sides: Sequence[Side]) -> tuple[str, ...]:
    """Return a note where two stages are put beside each other that are not of one shot."""
    from usdmotion.usd.seeing import in_common

    if len(sides) < 2 or in_common(sides):
        return ()
    before, after = sides
    return (
        f"{after.path} has no skeleton and no surface in common with {before.path}: the rows show "
        "two shots and not what became of one",
    )


def _require_something(stage: Path, sceneries: Sequence[Scenery], codes: Floats) -> None:
    if all(each.is_empty for each in sceneries):
        raise SceneError(
            f"{stage}: there is nothing to see at {', '.join(f'{code:g}' for code in codes)}: no "
            "body that an animation moves, and no surface that is visible"
        )


def _require_camera(sides: Sequence[Side], camera: str) -> None:
    from usdmotion.usd.seeing import find_camera

    for side in sides if camera else ():
        try:
            find_camera(side.stage, camera)
        except SceneError as error:
            raise SceneError(f"{side.path}: {error}") from error


def _codes(
    sides: Sequence[Side],
    tiers: Sequence[Sequence[float]],
    asked: Span | Sequence[float] | None,
) -> Floats:
    """Return the time codes of the columns."""
    from usdmotion.usd.seeing import moved_skeletons, span_of

    spans = [span_of(side.stage, side.facts) for side in sides]
    facts = sides[0].facts
    step = facts.time_codes_per_second / facts.frames_per_second
    clip = Clip(min(first for first, _ in spans), max(last for _, last in spans), step)
    if asked is not None:
        return asked_for(asked, clip)
    count = usual(max(len(moved_skeletons(side.stage)) for side in sides))
    return telling(tiers, clip, count)
