"""Surfaces of a stage, as many triangles as can be seen in a picture."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats, Ints
from usdmotion.drawing.strips import Surface

if TYPE_CHECKING:
    from usdmotion.usd.seeing import SeenSurface

Color = tuple[float, float, float]
PLAIN: Color = (0.6, 0.6, 0.6)
"""Of a surface that says nothing of its colour, linear."""
_MANY = 8000
"""A surface with more triangles is drawn with fewer."""
_FINE = 0.006
"""What is nearer to each other than this is one point of it then, over its size."""


def drawn(seen: SeenSurface, color: Color = PLAIN, *, beyond: bool) -> Surface:
    """Return a surface as it is drawn.

    Args:
        seen: The surface.
        color: What it is drawn with where nothing says of which colour it is.
        beyond: Whether it may go beyond the panel.
    """
    points, triangles = seen.points, seen.triangles
    if len(triangles) > _MANY:
        points, triangles = _thinned(points, triangles)
    closed = _is_closed(triangles)
    if closed and _volume(points, triangles) < 0.0:
        triangles = triangles[:, ::-1]
    return Surface(points, triangles, seen.color or color, seen.opacity, not closed, beyond)


def lies_under(surfaces: Iterable[SeenSurface], places: Floats, up: Floats) -> bool:
    """Tell whether one of some surfaces reaches, seen from above, around all of some places.

    Args:
        surfaces: Surfaces that no skeleton moves.
        places: World [m], shape (place_count, 3).
        up: Away from the ground, shape (3,).
    """
    level = np.flatnonzero(np.abs(up) < 0.5)
    low, high = places[:, level].min(axis=0), places[:, level].max(axis=0)
    top = (places @ up).max()
    for each in surfaces:
        flat = each.points[:, level]
        around = (flat.min(axis=0) <= low).all() and (flat.max(axis=0) >= high).all()
        if around and (each.points @ up).min() <= top:
            return True
    return False


def _thinned(points: Floats, triangles: Ints) -> tuple[Floats, Ints]:
    """Return a surface with points that are near to each other put together."""
    size = _FINE * float(np.ptp(points, axis=0).max())
    cells = np.floor((points - points.min(axis=0)) / max(size, 1e-12)).astype(np.int64)
    _, first, place = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    merged = place.reshape(-1)[triangles]
    whole = (merged != np.roll(merged, 1, axis=1)).all(axis=1)
    _, once = np.unique(np.sort(merged[whole], axis=1), axis=0, return_index=True)
    return points[first], merged[whole][np.sort(once)]


def _is_closed(triangles: Ints) -> bool:
    """Tell whether each edge has another triangle on its other side, turned the same way."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    there = np.unique(edges, axis=0)
    back = np.unique(edges[:, ::-1], axis=0)
    return len(there) == len(edges) and np.array_equal(there, back)


def _volume(points: Floats, triangles: Ints) -> float:
    a, b, c = (points[triangles[:, corner]] - points.mean(axis=0) for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)))
