"""One panel of a strip: the ground, what is solid from far to near, and the signs above it."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.bodies import limbs
from usdmotion.drawing.cutting import pieces
from usdmotion.drawing.eyes import Placed, Window
from usdmotion.drawing.framing import size
from usdmotion.drawing.polygons import Polygons, rgb
from usdmotion.drawing.signs import draw_spots
from usdmotion.drawing.solids import curve, outline, patch, surface
from usdmotion.drawing.strips import Body, Curve, Panel, Patch, Spot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import TransformedBbox

_SQUARE = 0.5
"""Width of a square of the ground [m]."""
_MOST_SQUARES = 40
_GRID = "#e1e6ea"
_BEFORE = 0.3
"""How much nearer a result is taken to be than it is, where its input is drawn behind it [m]."""
_THROUGH = 0.28
"""How strong a curve is where a body hides it."""
_SMALL = 0.06
"""Longest edge of a triangle before it is cut, over the width of the picture."""
_GROUND = 0.5
"""How much nearer a limb is taken than it is, over that edge: it stands on what it touches."""


def draw_panel(sheet: "Axes", panel: Panel, eye: Placed) -> None:
    """Draw a panel.

    Args:
        sheet: Where, in points of print.
        panel: What.
        eye: Its eye, put where the panel is on the sheet.
    """
    clip = _clip(sheet, eye.window)
    middle, across = _middle(panel, eye)
    if panel.ground is not None:
        _grid(sheet, panel.ground, np.array(panel.up), eye, middle, across, clip)
    solids = Polygons.together(list(_solids(panel, eye, across)))
    solids.draw(sheet, order=1.0, clip=clip)
    _through(sheet, panel, eye, clip)
    _spots(sheet, panel, eye)


def _clip(sheet: "Axes", window: Window) -> "TransformedBbox":
    from matplotlib.transforms import Bbox, TransformedBbox

    return TransformedBbox(Bbox.from_extents(*window), sheet.transData)


def _middle(panel: Panel, eye: Placed) -> tuple[Floats, float]:
    """Return the middle of what there is to be seen [m], and how wide the picture is there [m]."""
    there = [body.pose[0].mean(axis=0) for body in panel.bodies]
    there += [each.points.mean(axis=0) for each in panel.surfaces if not each.beyond]
    there += [each.points.mean(axis=0) for each in panel.surfaces[:1]] if not there else []
    middle = np.mean(there or [np.zeros(3)], axis=0)
    return middle, size(eye.window)[0] / float(eye.size(middle))


def _solids(panel: Panel, eye: Placed, across: float) -> Iterator[Polygons]:
    """Yield what hides each other in a panel."""
    up, longest = np.array(panel.up), _SMALL * across
    for each in panel.surfaces:
        yield surface(each, eye, up, longest)
    for body in panel.bodies:
        yield _body(panel, body, eye, _GROUND * longest)
    for mark in panel.marks:
        if isinstance(mark, Patch) and len(mark.points) > 2:
            yield patch(mark, eye, longest)
            yield curve(outline(mark), eye, 1.6 * longest)
        elif isinstance(mark, Curve) and not mark.dashed:
            # Of two that are at one place the stronger is seen.
            yield curve(mark, eye, (0.6 + 0.9 * mark.opacity) * longest)


def _body(panel: Panel, body: Body, eye: Placed, lift: float) -> Polygons:
    """Return the limbs of a body, those of a result before those of an input."""
    drawn = limbs(body.mannequin, eye, body.pose, body.kind, body.number)
    kinds = {each.kind for each in panel.bodies}
    if body.kind != "before" and "before" in kinds:
        lift += _BEFORE
    return replace(drawn, near=drawn.near + lift)


def _through(sheet: "Axes", panel: Panel, eye: Placed, clip: "TransformedBbox") -> None:
    """Draw curves, pale where something hides them, that are not drawn among what is solid."""
    from matplotlib.collections import LineCollection

    for dashed in (False, True):
        curves = [m for m in panel.marks if isinstance(m, Curve) and m.dashed == dashed]
        runs = [(eye.flat(run), curve) for curve in curves for run in pieces(curve.points, eye)]
        part = 1.0 if dashed else _THROUGH
        drawn = LineCollection(
            [run for run, _ in runs],
            colors=[tuple(rgb(curve.color, part * curve.opacity)) for _, curve in runs],
            linewidths=[curve.width for _, curve in runs],
            linestyles=(0.0, (2.5, 1.8)) if dashed else "solid",
            zorder=2.0,
        )
        sheet.add_collection(drawn, autolim=False)
        drawn.set_clip_box(clip)


def _spots(sheet: "Axes", panel: Panel, eye: Placed) -> None:
    """Draw the signs of a panel, those left out that are behind the eye or beside the picture."""
    spots = [mark for mark in panel.marks if isinstance(mark, Spot)]
    if not spots:
        return
    there = np.array([spot.point for spot in spots])
    places = eye.flat(there)
    left, bottom, right, top = eye.window
    inside = ((places >= (left, bottom)) & (places <= (right, top))).all(axis=1)
    seen = np.flatnonzero(inside & (eye.near(there) < eye.limit))
    draw_spots(sheet, [spots[index] for index in seen], places[seen], eye.window)


def _grid(
    sheet: "Axes",
    level: float,
    up: Floats,
    eye: Placed,
    middle: Floats,
    across: float,
    clip: "TransformedBbox",
) -> None:
    """Draw squares on level ground under the middle of a panel."""
    from matplotlib.collections import LineCollection

    count = min(int(np.ceil(0.75 * across / _SQUARE)) + 1, _MOST_SQUARES)
    first, second = (np.eye(3)[each] for each in np.argsort(np.abs(up), kind="stable")[:2])
    corner = (np.round(middle @ first / _SQUARE), np.round(middle @ second / _SQUARE))
    steps = _SQUARE * np.arange(-count, count + 1)
    lines = []
    for along, aside, start in ((first, second, corner), (second, first, corner[::-1])):
        for step in steps:
            way = (_SQUARE * start[0] + steps)[:, None] * along
            line = way + (_SQUARE * start[1] + step) * aside + level * up
            lines += [eye.flat(run) for run in pieces(line, eye)]
    drawn = LineCollection(lines, colors=_GRID, linewidths=0.6, zorder=0.0)
    sheet.add_collection(drawn, autolim=False)
    drawn.set_clip_box(clip)
