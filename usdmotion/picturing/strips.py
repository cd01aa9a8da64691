"""The strip of a picture: columns are frames, rows are views of a stage before and after."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.eyes import Eye
from usdmotion.drawing.framing import shows
from usdmotion.drawing.strips import Mark, Panel, Row, Strip
from usdmotion.errors import SceneError
from usdmotion.picturing.looking import Looked
from usdmotion.picturing.scenery import Scenery, common_ground
from usdmotion.picturing.views import ahead_of, camera_of
from usdmotion.showing.contacts import contact_marks
from usdmotion.showing.marking import AROUND, marks

if TYPE_CHECKING:
    from usdmotion.usd.seeing import Side

_KINDS = {"alone": "", "before": "before", "after": "after"}


def strip_of(looked: Looked) -> Strip:
    """Return the strip of what is looked at."""
    up = looked.sceneries[0].side.facts.up
    ahead = ahead_of(looked.sceneries[0].bodies, up)
    ground = common_ground(looked.sceneries, up)
    rows = [
        _row(looked, scenery, view, ahead, ground)
        for view in looked.views or ("",)
        for scenery in looked.sceneries
    ]
    return Strip(tuple(rows), _caption(looked))


def empty_panels(looked: Looked, strip: Strip) -> tuple[str, ...]:
    """Return a note on the panels of a strip in which nobody and nothing is to be seen."""
    blind = {panel.title: None for row in strip.rows for panel in row.panels if not shows(panel)}
    if not looked.camera or not blind:
        return ()
    return (
        f"nothing that is drawn is before <{looked.camera}> at {', '.join(blind)}; look through "
        "another camera, or name a --view",
    )


def _row(looked: Looked, scenery: Scenery, view: str, ahead: Floats, ground: float | None) -> Row:
    side = scenery.side
    up = side.facts.up
    name = view if len(looked.views) > 1 else ""
    title = ", ".join(each for each in (name, _KINDS[side.kind]) if each)
    panels = tuple(
        Panel(
            title=f"{code:g}",
            eye=camera_of(view, ahead, up) if view else _through(side, looked.camera, float(code)),
            bodies=scenery.limbs(frame),
            surfaces=scenery.drawn(frame, follows=bool(view)),
            marks=_marks(looked, scenery, float(code)),
            ground=ground,
            up=(float(up[0]), float(up[1]), float(up[2])),
        )
        for frame, code in enumerate(looked.codes)
    )
    return Row(title, panels)


def _through(side: Side, path: str, code: float) -> Eye:
    from usdmotion.usd.seeing import find_camera, see_through

    try:
        return see_through(find_camera(side.stage, path), code, side.facts)
    except SceneError as error:
        raise SceneError(f"{side.path}: {error}") from error


def _marks(looked: Looked, scenery: Scenery, code: float) -> tuple[Mark, ...]:
    """Return what is drawn over the poses at a time; nothing outside of what a scene is about."""
    apart = AROUND * scenery.side.facts.time_codes_per_second
    contacts = scenery.contacts
    near = [c for c in contacts if c.always or c.first - apart <= code <= c.last + apart]
    found = list(contact_marks(near, code))
    for shown in looked.scenes:
        codes = shown.scene.time_codes
        frame = int(np.abs(codes - code).argmin())
        step = float(np.diff(codes).max(initial=1.0))
        if abs(codes[frame] - code) <= step:
            after = scenery.side.kind == "after"
            found += marks(shown, frame, after=after)
    return tuple(found)


def _caption(looked: Looked) -> str:
    """Return what there is to be seen, in a sentence."""
    codes = ", ".join(f"{code:g}" for code in looked.codes)
    where = f"through <{looked.camera}>" if looked.camera else " and ".join(looked.views)
    what = {1: "", 2: "; the upper row is before, the lower after"}[len(looked.sceneries)]
    return f"Time codes {codes}, {where}{what}."
