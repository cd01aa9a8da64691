"""Surfaces, flat areas and curves as polygons that hide each other."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.cutting import beside, halved, in_front, pieces
from usdmotion.drawing.eyes import Placed
from usdmotion.drawing.polygons import Polygons, over_white, rgb
from usdmotion.drawing.strips import Curve, Patch, Surface

_DARK = 0.62
"""How bright a surface is that the light does not reach."""
_PALE = 0.6
"""How strong the colour is of what goes beyond the panel."""
_BEHIND = 2.0
"""How much farther away than it is what things stand on is taken, over the longest edge."""
_LIFT = 0.6
"""How much nearer than it is what lies on a ground is taken, over the longest edge."""


def surface(surface: Surface, eye: Placed, up: Floats, longest: float) -> Polygons:
    """Return a surface as shaded triangles.

    Args:
        surface: What is seen.
        eye: From where, on its place on the sheet.
        up: Away from the ground, shape (3,).
        longest: Longest edge of a triangle [m].
    """
    corners = in_front(surface.points[surface.triangles], eye)
    flat = eye.flat(corners)
    turned = _turned(flat)
    seen = ~beside(flat, eye.window) & ((turned != 0.0) if surface.both_sides else (turned > 0.0))
    corners = np.where((turned < 0.0)[:, None, None], corners[:, ::-1], corners)[seen]
    corners = halved(corners, eye, eye.window, longest)
    light = _DARK + (1.0 - _DARK) * _light(corners, eye, up)
    color = rgb(surface.color, surface.opacity)
    near = eye.near(corners.mean(axis=1))
    if surface.beyond:
        # What things stand on is behind them, and paler than they are.
        near -= _BEHIND * longest
        color[:3] = 1.0 - _PALE * (1.0 - color[:3])
    fills = np.column_stack([light[:, None] * color[:3], np.full(len(light), color[3])])
    return Polygons.plain(eye.flat(corners), near, fills)


def patch(patch: Patch, eye: Placed, longest: float) -> Polygons:
    """Return a flat area, opaque, over the ground on which it lies.

    Args:
        patch: What is seen, its outline convex.
        eye: From where, on its place on the sheet.
        longest: Longest edge of a triangle [m].
    """
    points = patch.points
    count = max(len(points) - 2, 0)
    fan = np.column_stack([np.zeros(count), np.arange(count) + 1, np.arange(count) + 2])
    corners = halved(in_front(points[fan.astype(np.int64)], eye), eye, eye.window, longest)
    color = over_white(rgb(patch.color, patch.opacity))
    near = eye.near(corners.mean(axis=1)) + _LIFT * longest
    return Polygons.plain(eye.flat(corners), near, color)


def curve(curve: Curve, eye: Placed, fineness: float, lift: float) -> Polygons:
    """Return a curve as a ribbon of its width, opaque.

    Args:
        curve: What is seen.
        eye: From where, on its place on the sheet.
        fineness: How wide it is, over how wide it says it is.
        lift: How much nearer it is taken than it is [m].
    """
    color = over_white(rgb(curve.color, curve.opacity))
    shapes, near = [np.zeros((0, 4, 2))], [np.zeros(0)]
    for run in pieces(curve.points, eye):
        ribbon, kept = _ribbon(eye.flat(run), 0.5 * fineness * curve.width)
        shapes.append(ribbon)
        near.append((eye.near(0.5 * (run[1:] + run[:-1])) + lift)[kept])
    drawn = np.concatenate(shapes)
    seen = ~beside(drawn, eye.window)
    return Polygons.plain(drawn[seen], np.concatenate(near)[seen], color)


def outline(patch: Patch) -> Curve:
    """Return the line around a flat area."""
    closed = np.concatenate([patch.points, patch.points[:1]])
    return Curve(closed, patch.color, 0.8, min(1.0, 2.0 * patch.opacity))


def _ribbon(flat: Floats, half: float) -> tuple[Floats, Floats]:
    """Return a rectangle for each segment of a polyline that has a length, and which have one."""
    along = np.diff(flat, axis=0)
    length = np.linalg.norm(along, axis=1)
    kept = length > 1e-3 * half
    along = along[kept] / length[kept, None] * half
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    # A bit longer, so that there is no gap where it bends.
    first, last = flat[:-1][kept] - 0.5 * along, flat[1:][kept] + 0.5 * along
    sides = [first - across, last - across, last + across, first + across]
    return np.stack(sides, axis=1), kept


def _turned(flat: Floats) -> Floats:
    """Return twice the area of triangles, positive where counterclockwise, (count, 3, 2)."""
    one, other = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    return np.asarray(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])


def _light(corners: Floats, eye: Placed, up: Floats) -> Floats:
    """Return how much light triangles get, 0..1, (count, 3, 3) to (count,).

    It comes from over the left shoulder of whoever looks.
    """
    towards = eye.near(np.eye(3)) - eye.near(np.zeros(3))
    left = np.cross(towards, up)
    light = towards + 1.2 * up + 0.6 * left
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    share = normals @ light / np.maximum(lengths * np.linalg.norm(light), 1e-30)
    return np.asarray(np.clip(share, 0.0, 1.0))
