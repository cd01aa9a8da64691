"""Looking at a stage: which frames, from where, and what there is to be seen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.arrays import Floats
from usdmotion.asking import Span
from usdmotion.errors import SceneError
from usdmotion.grounding import Told
from usdmotion.picturing.frames import Clip, asked_for, telling, usual
from usdmotion.picturing.moments import tiers_of
from usdmotion.picturing.scenery import Scenery, look
from usdmotion.picturing.views import USUAL, require_askable
from usdmotion.plugins import host
from usdmotion.showing import ShownScene
from usdmotion.surveying import survey

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
    shot: Path,
    *,
    frames: Span | Sequence[float] | None = None,
    views: Sequence[str] = (),
    camera: str = "",
    compare: Path | None = None,
    ground: Told | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Looked:
    """Return all that a strip is made of, as `picture` draws it.

    Args:
        shot: The stage, or a layer of results beside the shot that it was made from.
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
    say(f"reading {shot}")
    sides = sides_of(usd.files_of(shot, kinds=host().constraints), compare)
    _require_camera(sides, camera)
    last, program = sides[-1], "usdmotion.picturing.picture"
    found = survey(last.stage, last.path, program=program, ground=ground, say=say)
    codes = _codes(sides, found.scenes, frames)
    say("looking")
    sceneries, notes = zip(*(look(side, codes) for side in sides), strict=True)
    if all(each.is_empty for each in sceneries):
        raise SceneError(
            f"{shot}: there is nothing to see at {', '.join(f'{code:g}' for code in codes)}: no "
            "body that an animation moves, and no surface that is visible"
        )
    return Looked(
        sceneries=sceneries,
        codes=codes,
        scenes=found.scenes,
        camera=camera,
        views=() if camera else tuple(views) or (USUAL,),
        notes=tuple(dict.fromkeys((*found.notes, *(each for told in notes for each in told)))),
    )


def _require_camera(sides: Sequence[Side], camera: str) -> None:
    from usdmotion.usd.seeing import find_camera

    for side in sides if camera else ():
        try:
            find_camera(side.stage, camera)
        except SceneError as error:
            raise SceneError(f"{side.path}: {error}") from error


def _codes(
    sides: Sequence[Side], scenes: Sequence[ShownScene], asked: Span | Sequence[float] | None
) -> Floats:
    """Return the time codes of the columns."""
    from usdmotion.usd.seeing import moved_skeletons, span_of

    spans = [span_of(side.stage, side.facts) for side in sides]
    facts = sides[0].facts
    step = facts.time_codes_per_second / facts.frames_per_second
    clip = Clip(min(first for first, _ in spans), max(last for _, last in spans), step)
    if asked is not None:
        return asked_for(asked, clip)
    count = usual(max(sum(1 for _ in moved_skeletons(side.stage)) for side in sides))
    return telling(tiers_of(scenes), clip, count)
