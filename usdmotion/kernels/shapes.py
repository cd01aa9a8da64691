"""How far a point is from a shape, and in which direction that grows."""

import math
from typing import Any

from usdmotion.arrays import Floats
from usdmotion.kernels.compiling import kernel, shared
from usdmotion.kernels.quaternions import vector_at
from usdmotion.kernels.table import Shape

BOX, CYLINDER = int(Shape.BOX), int(Shape.CYLINDER)
Gap = tuple[float, float, float, float]
"""A unit direction, and the distance that grows along it."""


@kernel
def gaps(shape: int, extents: Floats, points: Floats) -> tuple[Floats, Floats]:
    """(N, 3), (N, 3) in the shape's frame to directions (N, 3) and signed distances (N,) [m]."""
    directions = points.copy()
    distances = extents[:, 0].copy()
    for index in range(points.shape[0]):
        found = gap(shape, vector_at(extents, index), vector_at(points, index))
        directions[index, 0], directions[index, 1], directions[index, 2] = found[:3]
        distances[index] = found[3]
    return directions, distances


@shared
def gap(shape: int, extent: Any, point: Any) -> Gap:
    """Return the direction away from a shape and the distance along it, negative inside."""
    if shape == BOX:
        return _box_gap(extent, point)
    if shape == CYLINDER:
        return _cylinder_gap(extent, point)
    return (0.0, 0.0, 1.0, point[2])


@shared
def _box_gap(extent: Any, point: Any) -> Gap:
    """Outside from the nearest point, inside from the nearest face."""
    x = abs(point[0]) - extent[0]
    y = abs(point[1]) - extent[1]
    z = abs(point[2]) - extent[2]
    out = (max(x, 0.0), max(y, 0.0), max(z, 0.0))
    length = math.sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2])
    if length > 0.0:
        scale = 1.0 / length
        return (
            math.copysign(out[0] * scale, point[0]),
            math.copysign(out[1] * scale, point[1]),
            math.copysign(out[2] * scale, point[2]),
            length,
        )
    if x >= y and x >= z:
        return (math.copysign(1.0, point[0]), 0.0, 0.0, x)
    if y >= z:
        return (0.0, math.copysign(1.0, point[1]), 0.0, y)
    return (0.0, 0.0, math.copysign(1.0, point[2]), z)


@shared
def _cylinder_gap(extent: Any, point: Any) -> Gap:
    """As a box's in the plane through the axis and the point."""
    radius = math.sqrt(point[0] * point[0] + point[1] * point[1])
    ux, uy = (point[0] / radius, point[1] / radius) if radius > 0.0 else (1.0, 0.0)
    side = radius - extent[0]
    end = abs(point[2]) - extent[2]
    up = math.copysign(1.0, point[2])
    if side > 0.0 and end > 0.0:
        length = math.sqrt(side * side + end * end)
        return (ux * side / length, uy * side / length, up * end / length, length)
    if side >= end:
        return (ux, uy, 0.0, side)
    return (0.0, 0.0, up, end)
