"""Cutting off what is behind an eye or beside a picture, and large triangles into small ones."""

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.drawing.eyes import Eye, Window

_MOST = 60_000
"""No more triangles than about this are made by cutting."""
_ROUNDS = 14
"""Each of them at most halves a triangle."""


def in_front(corners: Floats, eye: Eye) -> Floats:
    """Return the parts of triangles that are before an eye, (count, 3, 3) to (other_count, 3, 3).

    Their corners keep their sense of rotation.
    """
    left = eye.limit - eye.near(corners)
    seen = left > 0.0
    count = seen.sum(axis=1)
    if (count == 3).all():
        return corners
    a, _, _, ab, ac = _cut(corners[count == 1], left[count == 1], seen[count == 1])
    _, b, c, cut_b, cut_c = _cut(corners[count == 2], left[count == 2], ~seen[count == 2])
    made = [(a, ab, ac), (cut_b, b, c), (cut_b, c, cut_c)]
    return np.concatenate([corners[count == 3], *(np.stack(each, axis=1) for each in made)])


def _cut(corners: Floats, left: Floats, alone: Bools) -> tuple[Floats, ...]:
    """Return the corner that is alone on its side, the next two, and the cuts towards them."""
    order = (alone.argmax(axis=1)[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(corners, order[:, :, None], axis=1).transpose(1, 0, 2)
    at_a, at_b, at_c = np.take_along_axis(left, order, axis=1).T
    ab = a + (at_a / (at_a - at_b))[:, None] * (b - a)
    ac = a + (at_a / (at_a - at_c))[:, None] * (c - a)
    return a, b, c, ab, ac


def pieces(points: Floats, eye: Eye) -> list[Floats]:
    """Return the parts of a polyline that are before an eye, each of shape (point_count, 3)."""
    left = eye.limit - eye.near(points)
    if (left > 0.0).all():
        return [points]
    found: list[Floats] = []
    own: list[Floats] = []
    for index, point in enumerate(points):
        if index and (left[index] > 0.0) != (left[index - 1] > 0.0):
            part = left[index] / (left[index] - left[index - 1])
            own.append(point + part * (points[index - 1] - point))
        if left[index] > 0.0:
            own.append(point)
        elif own:
            found.append(np.array(own))
            own = []
    return [*found, np.array(own)] if own else found


def beside(flat: Floats, window: Window) -> Bools:
    """Tell which shapes are wholly beside a window, (count, corner_count, 2) to (count,)."""
    low, high = flat.min(axis=1), flat.max(axis=1)
    left, bottom, right, top = window
    outside = (high < (left, bottom)) | (low > (right, top))
    return np.asarray(outside.any(axis=1))


def halved(corners: Floats, eye: Eye, window: Window, longest: float) -> Floats:
    """Return triangles none of which has an edge longer than that, those beside a window left out.

    Drawn from far to near, small triangles hide what is behind them and nothing else; a large one
    may be at once before and behind a body that stands on it.

    Args:
        corners: World [m], shape (count, 3, 3).
        eye: From where they are seen.
        window: What the picture shows.
        longest: Longest edge [m].
    """
    for _ in range(_ROUNDS):
        corners = corners[~beside(eye.flat(corners), window)]
        edges = np.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2)
        long = edges.max(axis=1) > longest
        if not long.any() or len(corners) + long.sum() > _MOST:
            break
        # Its longest edge, and the corner opposite of it.
        order = (edges[long].argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(corners[long], order[:, :, None], axis=1).transpose(1, 0, 2)
        middle = 0.5 * (a + b)
        halves = np.stack([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        corners = np.concatenate([corners[~long], halves.reshape(-1, 3, 3)])
    return corners
