"""The area that a body stands on, as polygons."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.guides.axes import sideways

_STRAIGHT = 1e-3
"""Corners that stand out by less from the line between their neighbours are none, over a margin."""


@dataclass(frozen=True, eq=False)
class SupportGuide:
    """A polygon around the points that bear a body, frame by frame, of as many corners each."""

    corners: Floats
    """Counterclockwise seen from above [m], shape (frame_count, corner_count, 3); the last is
    repeated where there are fewer."""
    there: Bools
    """Whether anything bears the body at all, shape (frame_count,)."""
    runs: Ints
    """Ascending numbers, one for frames on which the corners follow the same points, (F,)."""


def support_guide(supports: Floats, bearing: Bools, up: Floats, margin: float) -> SupportGuide:
    """Return the convex hull of the points that bear a body, seen along the up axis.

    Args:
        supports: Points that may bear it [m], shape (frame_count, count, 3).
        bearing: Which of them do, shape (frame_count, count).
        up: Away from the ground, shape (3,).
        margin: How far it goes around them, so that one that stands on a point is seen [m].
    """
    sides = np.stack(sideways(up))
    ways = margin * np.concatenate([sides, -sides])
    spread = supports[:, :, None] + ways  # four about each point
    flat = spread @ sides.T
    rings: list[tuple[int, ...]] = []
    for frame, on in enumerate(bearing):
        same = frame > 0 and (on == bearing[frame - 1]).all()
        if same and np.array_equal(supports[frame], supports[frame - 1]):
            rings.append(rings[-1])
        else:
            rings.append(_ring(flat[frame], np.flatnonzero(on), margin))
    count = max(max(map(len, rings), default=0), 3)
    points = spread.reshape(len(spread), -1, 3)
    corners = np.zeros((len(rings), count, 3))
    for frame, ring in enumerate(rings):
        if ring:
            corners[frame] = points[frame, [*ring, *[ring[-1]] * (count - len(ring))]]
    changes = [False, *(one != other for one, other in pairwise(rings))]
    return SupportGuide(corners, np.asarray(bearing.any(axis=1)), np.cumsum(changes))


def _ring(flat: Floats, on: Ints, margin: float) -> tuple[int, ...]:
    """Return the corners of a hull, (N, 4, 2) to indices of N times 4, from the first of them."""
    if len(on) == 0:
        return ()
    from scipy.spatial import ConvexHull

    points = flat[on].reshape(-1, 2)
    ring = _bent(points, ConvexHull(points).vertices, _STRAIGHT * margin)
    named = (4 * np.repeat(on, 4) + np.tile(np.arange(4), len(on)))[ring]
    return tuple(np.roll(named, -int(named.argmin())).tolist())


def _bent(points: Floats, ring: Ints, least: float) -> Ints:
    """Return the corners of a polygon that are at least so far from a line past them."""
    while True:
        before, after = points[np.roll(ring, 1)], points[np.roll(ring, -1)]
        along, off = after - before, points[ring] - before
        area = np.abs(along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0])
        aside = area / np.linalg.norm(along, axis=1)
        flattest = int(aside.argmin())
        if aside[flattest] > least:
            return ring
        ring = np.delete(ring, flattest)
