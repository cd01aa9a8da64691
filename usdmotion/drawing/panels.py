"""One panel of a strip: the ground, what is solid from far to near, and the signs above it."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.bodies import limbs
from usdmotion.drawing.cutting import pieces
from usdmotion.drawing.eyes import Window
from usdmotion.drawing.framing import size
from usdmotion.drawing.polygons import Polygons, rgb
from usdmotion.drawing.signs import draw_spots
from usdmotion.drawing.solids import curve, outline, patch, surface
from usdmotion.drawing.strips import Body, Curve, Panel, Patch, Spot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


def draw_panel(axes: "Axes", panel: Panel, window: Window, point: float) -> None:
    """Draw a panel.

    Args:
        axes: Where.
        panel: What.
        window: What is to be seen of its picture.
        point: One point of print in the picture.
    """
    axes.set(xlim=window[::2], ylim=window[1::2], aspect="equal", autoscale_on=False)
    axes.axis("off")
    middle, across = _middle(panel, window)
    if panel.ground is not None:
        _grid(axes, panel, middle, across)
    Polygons.together(list(_solids(panel, window, point, across))).draw(axes, order=1.0)
    for mark in panel.marks:
        if isinstance(mark, Curve):
            _through(axes, panel, mark)
    _spots(axes, panel, window, point)


def _middle(panel: Panel, window: Window) -> tuple[Floats, float]:
    """Return the middle of what there is to be seen [m], and how wide the picture is there [m]."""
    there = [body.pose[0].mean(axis=0) for body in panel.bodies]
    there += [each.points.mean(axis=0) for each in panel.surfaces if not each.beyond]
    there += [each.points.mean(axis=0) for each in panel.surfaces[:1]] if not there else []
    middle = np.mean(there or [np.zeros(3)], axis=0)
    return middle, size(window)[0] / float(panel.eye.size(middle))


def _solids(panel: Panel, window: Window, point: float, across: float) -> Iterator[Polygons]:
    """Yield what hides each other in a panel."""
    eye, up, longest = panel.eye, np.array(panel.up), _SMALL * across
    for each in panel.surfaces:
        yield surface(each, eye, window, up, longest)
    for body in panel.bodies:
        yield _body(panel, body, _GROUND * longest)
    for mark in panel.marks:
        if isinstance(mark, Patch) and len(mark.points) > 2:
            yield patch(mark, eye, window, longest)
            yield curve(outline(mark), eye, window, point, 1.6 * longest)
        elif isinstance(mark, Curve) and not mark.dashed:
            # Of two that are at one place the stronger is seen.
            yield curve(mark, eye, window, point, (0.6 + 0.9 * mark.opacity) * longest)


def _body(panel: Panel, body: Body, lift: float) -> Polygons:
    """Return the limbs of a body, those of a result before those of an input."""
    drawn = limbs(body.mannequin, panel.eye, body.pose, body.kind, body.number)
    kinds = {each.kind for each in panel.bodies}
    if body.kind != "before" and "before" in kinds:
        lift += _BEFORE
    return replace(drawn, near=drawn.near + lift)


def _through(axes: "Axes", panel: Panel, mark: Curve) -> None:
    """Draw a curve, pale where something hides it, that is not drawn among what is solid."""
    part = 1.0 if mark.dashed else _THROUGH
    for run in pieces(mark.points, panel.eye):
        axes.plot(
            *panel.eye.flat(run).T,
            color=tuple(rgb(mark.color, part * mark.opacity)),
            linewidth=mark.width,
            linestyle=(0.0, (2.5, 1.8)) if mark.dashed else "-",
            zorder=2.0,
        )


def _spots(axes: "Axes", panel: Panel, window: Window, point: float) -> None:
    """Draw the signs of a panel, those left out that are behind the eye or beside the picture."""
    spots = [mark for mark in panel.marks if isinstance(mark, Spot)]
    if not spots:
        return
    there = np.array([spot.point for spot in spots])
    places = panel.eye.flat(there) - window[:2]
    inside = ((places >= 0.0) & (places <= size(window))).all(axis=1)
    seen = np.flatnonzero(inside & (panel.eye.near(there) < panel.eye.limit))
    points = (size(window)[0] / point, size(window)[1] / point)
    draw_spots(axes, [spots[index] for index in seen], places[seen], point, points)


def _grid(axes: "Axes", panel: Panel, middle: Floats, across: float) -> None:
    """Draw squares on level ground under the middle of a panel."""
    from matplotlib.collections import LineCollection

    up = np.array(panel.up)
    count = min(int(np.ceil(0.75 * across / _SQUARE)) + 1, _MOST_SQUARES)
    first, second = (np.eye(3)[each] for each in np.argsort(np.abs(up), kind="stable")[:2])
    corner = (np.round(middle @ first / _SQUARE), np.round(middle @ second / _SQUARE))
    steps = _SQUARE * np.arange(-count, count + 1)
    lines = []
    for along, across_, start in ((first, second, corner), (second, first, corner[::-1])):
        for step in steps:
            way = (_SQUARE * start[0] + steps)[:, None] * along
            line = way + (_SQUARE * start[1] + step) * across_ + (panel.ground or 0.0) * up
            lines += [panel.eye.flat(run) for run in pieces(line, panel.eye)]
    axes.add_collection(LineCollection(lines, colors=_GRID, linewidths=0.6, zorder=0.0))
