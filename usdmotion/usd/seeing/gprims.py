"""One surface at one time, in its own frame: what its prim says, cut into triangles."""

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.usd.relations import is_a
from usdmotion.usd.surfaces import fans, read_shape

_AROUND = 24
"""Corners of a circle; in a picture nobody sees that there are not more."""
_MOST_POINTS = 2000
"""Of a cloud with more points, every so many are drawn."""
_SMALL = 0.01
"""Width of a point that says nothing of it, over the size of its cloud."""
_STAR = np.concatenate([np.eye(3), -np.eye(3)]) * 0.5
_STAR_FACES = np.array([(a, b, c) for a in (0, 3) for b in (1, 4) for c in (2, 5)])

Shape = tuple[Floats, Ints]
"""Points (point_count, 3) and triangles (triangle_count, 3)."""


def read_gprim(prim: Usd.Prim, time_code: float) -> Shape | None:
    """Return a surface in the frame and units of its prim; None for what is none, or is empty.

    Raises:
        SceneError: It is a mesh whose faces and points do not fit.
    """
    if is_a(prim, "UsdGeomMesh"):
        found: Shape | None = _mesh(prim, time_code)
    elif is_a(prim, "UsdGeomPoints"):
        found = _cloud(prim, time_code)
    else:
        found = read_shape(prim, time_code, _AROUND)
    return found if found is not None and len(found[1]) else None


def _mesh(prim: Usd.Prim, time_code: float) -> Shape:
    points, triangles = points_of(prim, time_code), fans(prim, time_code)
    if triangles.min(initial=0) < 0 or triangles.max(initial=-1) >= len(points):
        raise SceneError(f"<{prim.GetPath()}> has faces with corners that are no points of it")
    if not np.isfinite(points).all():
        raise SceneError(f"<{prim.GetPath()}> has a point that is not a number")
    return points, triangles


def points_of(prim: Usd.Prim, time_code: float) -> Floats:
    """Return the points of a point-based prim, shape (point_count, 3)."""
    found = UsdGeom.PointBased(prim).GetPointsAttr().Get(Usd.TimeCode(time_code))
    return np.array(() if found is None else found, dtype=np.float64).reshape(-1, 3)


def _cloud(prim: Usd.Prim, time_code: float) -> Shape | None:
    """Return points as small octahedra of their widths."""
    points = points_of(prim, time_code)
    if not len(points):
        return None
    held = UsdGeom.Points(prim).GetWidthsAttr().Get(Usd.TimeCode(time_code))
    plain = _SMALL * float(np.ptp(points, axis=0).max())
    widths = np.array([plain] if held is None or not len(held) else held, dtype=np.float64)
    widths = np.broadcast_to(widths if len(widths) == len(points) else widths[:1], len(points))
    seen = np.flatnonzero(np.isfinite(points).all(axis=1) & (widths > 0.0))
    seen = seen[:: 1 + len(seen) // _MOST_POINTS]
    stars = points[seen, None] + widths[seen, None, None] * _STAR
    firsts = len(_STAR) * np.arange(len(seen))
    return stars.reshape(-1, 3), (firsts[:, None, None] + _STAR_FACES).reshape(-1, 3)
