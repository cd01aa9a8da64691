"""What each panel of a strip shows: rows at one scale, and moments where they can be compared."""

from collections.abc import Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.cutting import beside, in_front
from usdmotion.drawing.eyes import Eye, Window
from usdmotion.drawing.strips import Curve, Panel, Row, Spot

_PAD = 0.05
"""Room around what is shown, over its size."""
_TOGETHER = 1.25
"""Panels show the same place where it is not larger than this, over what one of them needs."""
_FLAT = 1e-3
"""What has no height is shown in so much of its width, and what has no size in so much [m]."""
_EMPTY = (-1.0, -1.0, 1.0, 1.0)


def windows(rows: Sequence[Row]) -> list[list[Window]]:
    """Return what each panel of each row shows.

    Rows that look from the same side, as before and after do, show the same places at one scale.
    """
    views = [tuple(_view(panel.eye) for panel in row.panels) for row in rows]
    framed: list[list[Window]] = [[] for _ in rows]
    for view in dict.fromkeys(views):
        own = [index for index, each in enumerate(views) if each == view]
        columns = zip(*(rows[index].panels for index in own), strict=True)
        found = _framed([_union([_extent(panel) for panel in column]) for column in columns])
        for index in own:
            framed[index] = [
                panel.eye.window or window
                for panel, window in zip(rows[index].panels, found, strict=True)
            ]
    return framed


def shows(panel: Panel) -> bool:
    """Tell whether some body or surface is in a panel whose eye says what it shows."""
    eye, window = panel.eye, panel.eye.window
    if window is None:
        return bool(panel.bodies or panel.surfaces)
    for body in panel.bodies:
        ends = np.stack(body.mannequin.capsules(*body.pose), axis=1)
        seen = ends[(eye.near(ends) < eye.limit).all(axis=1)]
        if (~beside(eye.flat(seen), window)).any():
            return True
    corners = (in_front(each.points[each.triangles], eye) for each in panel.surfaces)
    return any((~beside(eye.flat(each), window)).any() for each in corners)


def widened(window: Window, width: float, height: float) -> Window:
    """Return a window of at least this size around the middle of another."""
    left, bottom, right, top = window
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    wide, tall = max(right - left, width), max(top - bottom, height)
    return x - 0.5 * wide, y - 0.5 * tall, x + 0.5 * wide, y + 0.5 * tall


def size(window: Window) -> tuple[float, float]:
    """Return how wide and how tall a window is."""
    return window[2] - window[0], window[3] - window[1]


def _view(eye: Eye) -> bytes:
    """Return what is the same of eyes that see the same."""
    axes = np.concatenate([np.eye(3), np.zeros((1, 3))])
    seen = np.column_stack([eye.flat(axes), eye.near(axes)])
    return np.round(np.append(seen.ravel(), eye.window or ()), 6).tobytes()


def _extent(panel: Panel) -> Window | None:
    """Return what a panel has to show; None if that is nothing."""
    eye, points = panel.eye, [np.zeros((0, 2))]
    for body in panel.bodies:
        starts, ends = body.mannequin.capsules(*body.pose)
        for there in (starts, ends):
            seen = eye.near(there) < eye.limit
            flat = eye.flat(there[seen])
            thick = (body.mannequin.radii[seen] * eye.size(there[seen]))[:, None]
            points += [flat - thick, flat + thick]
    shapes = [each.points for each in panel.surfaces if not each.beyond]
    for mark in panel.marks:
        if not mark.beyond:
            shapes.append(mark.point[None] if isinstance(mark, Spot) else mark.points)
    points += [_seen(eye, each) for each in shapes]
    flat = np.concatenate(points)
    if not len(flat):
        flat = np.concatenate([flat, *(_seen(eye, each) for each in _rest(panel))])
    if not len(flat):
        return None
    (left, bottom), (right, top) = flat.min(axis=0), flat.max(axis=0)
    return float(left), float(bottom), float(right), float(top)


def _rest(panel: Panel) -> list[Floats]:
    """Return what is shown where nothing has to be."""
    curves = [mark.points for mark in panel.marks if isinstance(mark, Curve)]
    return [each.points for each in panel.surfaces] or curves


def _seen(eye: Eye, points: Floats) -> Floats:
    return eye.flat(points[eye.near(points) < eye.limit])


def _union(extents: Sequence[Window | None]) -> Window | None:
    found = np.array([each for each in extents if each is not None])
    if not len(found):
        return None
    (left, bottom), (right, top) = found[:, :2].min(axis=0), found[:, 2:].max(axis=0)
    return float(left), float(bottom), float(right), float(top)


def _framed(extents: Sequence[Window | None]) -> list[Window]:
    """Return windows of one size, over one place where that does not make them much larger."""
    whole = _union(extents) or _EMPTY
    found = np.array([each or whole for each in extents])
    low, high = found[:, :2], found[:, 2:]
    size = (high - low).max(axis=0)
    least = _FLAT * (float(size.max()) or 1.0)
    size = np.maximum(size, least)
    middles = 0.5 * (low + high)
    together = np.subtract(whole[2:], whole[:2])
    for axis in range(2):
        if together[axis] <= _TOGETHER * size[axis]:
            middles[:, axis] = 0.5 * (whole[axis] + whole[axis + 2])
            size[axis] = max(together[axis], least)
    half = 0.5 * size + _PAD * size.max()
    return [(*(middle - half).tolist(), *(middle + half).tolist()) for middle in middles]
