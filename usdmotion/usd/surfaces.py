"""The surfaces of a stage as triangles in the world."""

from collections.abc import Callable
from typing import Any

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.usd.relations import is_a, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import world_matrices

_AROUND = 96
"""Corners of a circle: of a radius r it is r / 2000 from the true one at most."""
_AXES = {"X": [1, 2, 0], "Y": [2, 0, 1], "Z": [0, 1, 2]}
"""Which axes of a prim are across, across and along what is round."""
_FLAT = {"X": (2, 1), "Y": (0, 2), "Z": (0, 1)}
"""Along which axes of a plane its width and its length are."""


def read_triangles(prim: Usd.Prim, time_codes: Floats, facts: Facts) -> tuple[Floats, Ints]:
    """Return a surface in the world.

    Polygons are cut into fans, as they stand: no subdivision scheme is followed.

    Args:
        prim: A Mesh, Cube, Sphere, Cylinder or Capsule.
        time_codes: The frames.
        facts: Units of the stage.

    Returns:
        Points [m], shape (frame_count, point_count, 3), or of one frame where it stays; and the
        points of each triangle, shape (triangle_count, 3).

    Raises:
        SceneError: It is no sound mesh, or another one from frame to frame.
    """
    if is_a(prim, "UsdGeomMesh"):
        triangles = fans(prim, time_codes[0])
        points = _over(prim, ("points",), time_codes, _plain)
        _require_points(prim, triangles, points)
    else:
        names, shape = next(each for kind, each in _SHAPES.items() if is_a(prim, kind))
        points = _over(prim, names, time_codes, lambda *sizes: shape(prim, _AROUND, *sizes)[0])
        triangles = shape(prim, _AROUND, *np.ones(len(names)))[1]
    matrices = world_matrices(prim, time_codes)
    placed = points @ matrices[:, :3, :3] + matrices[:, None, 3, :3]
    return placed * facts.meters_per_unit, triangles


def read_shape(prim: Usd.Prim, time_code: float, around: int) -> tuple[Floats, Ints] | None:
    """Return a shape that is no mesh in its own frame and units, None for one that is unknown.

    Args:
        prim: A Gprim.
        time_code: When.
        around: Corners of a circle, a multiple of 4.

    Returns:
        Points, shape (point_count, 3), and triangles, shape (triangle_count, 3).
    """
    found = next((each for kind, each in _SHAPES.items() if is_a(prim, kind)), None)
    if found is None:
        return None
    names, shape = found
    sizes = [float(prim.GetAttribute(name).Get(Usd.TimeCode(time_code))) for name in names]
    return shape(prim, around, *sizes)


def fans(prim: Usd.Prim, time_code: float) -> Ints:
    """Return the triangles of a mesh (triangle_count, 3), a fan for each polygon that is no hole.

    Raises:
        SceneError: Its faces do not add up.
    """
    start = Usd.TimeCode(time_code)
    counts, corners = (
        np.array(prim.GetAttribute(name).Get(start) or (), dtype=np.int64)
        for name in ("faceVertexCounts", "faceVertexIndices")
    )
    if counts.min(initial=0) < 0 or counts.sum() != len(corners):
        raise SceneError(
            f"<{prim.GetPath()}> has {len(corners)} faceVertexIndices where its faceVertexCounts "
            f"add up to {counts.sum()}; author them again"
        )
    firsts = np.cumsum(counts) - counts
    holes = np.isin(np.arange(len(counts)), np.array(value(prim, "holeIndices", ()), dtype=int))
    cuts = np.where(holes, 0, np.maximum(counts - 2, 0))
    first = np.repeat(firsts, cuts)
    within = np.arange(cuts.sum()) - np.repeat(np.cumsum(cuts) - cuts, cuts)
    found = np.stack([first, first + within + 1, first + within + 2], axis=1)
    return np.asarray(corners[found], dtype=np.int64)


def _over(
    prim: Usd.Prim, names: tuple[str, ...], time_codes: Floats, made: Callable[..., Floats]
) -> Floats:
    """Return what is made of attributes over the frames, or once where they do not change."""
    attributes = [prim.GetAttribute(name) for name in names]
    moves = any(each.ValueMightBeTimeVarying() for each in attributes)
    found = [
        made(*(each.Get(Usd.TimeCode(code)) for each in attributes))
        for code in (time_codes if moves else time_codes[:1])
    ]
    if len({len(each) for each in found}) > 1:
        raise SceneError(
            f"<{prim.GetPath()}> has another number of points from frame to frame, and cannot be "
            "followed as a ground; give it one mesh that moves"
        )
    return np.array(found)


def _plain(points: Any) -> Floats:
    return np.array(() if points is None else points, dtype=np.float64).reshape(-1, 3)


def _require_points(prim: Usd.Prim, triangles: Ints, points: Floats) -> None:
    if (
        points.ndim != 3
        or triangles.min(initial=0) < 0
        or triangles.max(initial=-1) >= points.shape[1]
    ):
        raise SceneError(
            f"<{prim.GetPath()}> has faces with corners that are no points of it; author them again"
        )
    if not np.isfinite(points).all():
        raise SceneError(f"<{prim.GetPath()}> has a point that is not a number; author it again")


def _cube(prim: Usd.Prim, around: int, size: float) -> tuple[Floats, Ints]:
    points = size * (np.array(list(np.ndindex(2, 2, 2))) - 0.5)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, np.array([each for a, b, c, d in quads for each in ((a, b, c), (a, c, d))])


def _sphere(prim: Usd.Prim, around: int, radius: float) -> tuple[Floats, Ints]:
    turns = np.linspace(-0.5 * np.pi, 0.5 * np.pi, around // 2 + 1)
    return _round(around, radius * np.cos(turns), radius * np.sin(turns), "Z")


def _cylinder(prim: Usd.Prim, around: int, radius: float, height: float) -> tuple[Floats, Ints]:
    half = 0.5 * height
    along = np.array((-half, -half, half, half))
    outward = radius * np.array((0.0, 1.0, 1.0, 0.0))
    return _round(around, outward, along, _axis(prim))


def _cone(prim: Usd.Prim, around: int, radius: float, height: float) -> tuple[Floats, Ints]:
    along = 0.5 * height * np.array((-1.0, -1.0, 1.0))
    return _round(around, radius * np.array((0.0, 1.0, 0.0)), along, _axis(prim))


def _capsule(prim: Usd.Prim, around: int, radius: float, height: float) -> tuple[Floats, Ints]:
    turns = np.linspace(0.0, 0.5 * np.pi, around // 4 + 1)
    outward, along = radius * np.cos(turns), 0.5 * height + radius * np.sin(turns)
    whole = np.concatenate([outward[::-1], outward]), np.concatenate([-along[::-1], along])
    return _round(around, *whole, _axis(prim))


def _plane(prim: Usd.Prim, around: int, width: float, length: float) -> tuple[Floats, Ints]:
    across, beside = _FLAT[_axis(prim)]
    points = np.zeros((4, 3))
    points[:, across] = 0.5 * width * np.array((-1.0, 1.0, 1.0, -1.0))
    points[:, beside] = 0.5 * length * np.array((-1.0, -1.0, 1.0, 1.0))
    return points, np.array([(0, 1, 2), (0, 2, 3)])


def _axis(prim: Usd.Prim) -> str:
    return str(value(prim, "axis", "Z"))


def _round(around: int, outward: Floats, along: Floats, axis: str) -> tuple[Floats, Ints]:
    """Return the surface of a profile that goes around an axis."""
    turns = 2.0 * np.pi * np.arange(around) / around
    rings = [outward[:, None] * np.cos(turns), outward[:, None] * np.sin(turns)]
    points = np.stack([*rings, np.broadcast_to(along[:, None], rings[0].shape)], axis=-1)
    placed = np.empty_like(points)
    placed[..., _AXES[axis]] = points
    index = np.arange(len(along) * around).reshape(-1, around)
    beside = np.roll(index, -1, axis=1)
    low = np.stack([index[:-1], beside[:-1], beside[1:]], axis=-1)
    high = np.stack([index[:-1], beside[1:], index[1:]], axis=-1)
    return placed.reshape(-1, 3), np.concatenate([low.reshape(-1, 3), high.reshape(-1, 3)])


_SHAPES: dict[str, tuple[tuple[str, ...], Callable[..., tuple[Floats, Ints]]]] = {
    "UsdGeomCube": (("size",), _cube),
    "UsdGeomSphere": (("radius",), _sphere),
    "UsdGeomCylinder": (("radius", "height"), _cylinder),
    "UsdGeomCapsule": (("radius", "height"), _capsule),
    "UsdGeomCone": (("radius", "height"), _cone),
    "UsdGeomPlane": (("width", "length"), _plane),
}
"""The sizes of each shape, and how it is made of them."""
