"""The surface under points: triangles in the cells of a grid, seen from above."""

# mypy: disable-error-code="no-any-return"
import math

from usdmotion.arrays import Floats, Ints
from usdmotion.kernels.compiling import kernel, shared

_BESIDE = 1e-9
"""How far beside a triangle a point is on it still, as a share: no seam lets anything through."""
_FLAT = 1e-12
"""A triangle whose area seen from above is smaller than this stands upright [m²]."""


@kernel
def count_cells(corners: Floats, low: Floats, size: Floats, shape: Ints, counts: Ints) -> None:
    """(T, 3, 3), (2,), (2,), (2,) into (C + 1,): how many triangles lie over the cells before."""
    for triangle in range(corners.shape[0]):
        first_x, last_x = _cells(corners, triangle, 0, low[0], size[0], shape[0])
        first_y, last_y = _cells(corners, triangle, 1, low[1], size[1], shape[1])
        for x in range(first_x, last_x + 1):
            for y in range(first_y, last_y + 1):
                counts[x * shape[1] + y + 1] += 1
    for cell in range(1, counts.shape[0]):
        counts[cell] += counts[cell - 1]


@kernel
def fill_cells(
    corners: Floats, low: Floats, size: Floats, shape: Ints, free: Ints, inside: Ints
) -> None:
    """(T, 3, 3), (2,), (2,), (2,), (C,) into (N,): the triangles over each cell, cell by cell."""
    for triangle in range(corners.shape[0]):
        first_x, last_x = _cells(corners, triangle, 0, low[0], size[0], shape[0])
        first_y, last_y = _cells(corners, triangle, 1, low[1], size[1], shape[1])
        for x in range(first_x, last_x + 1):
            for y in range(first_y, last_y + 1):
                cell = x * shape[1] + y
                inside[free[cell]] = triangle
                free[cell] += 1


@kernel
def surface_under(
    corners: Floats,
    low: Floats,
    size: Floats,
    shape: Ints,
    starts: Ints,
    inside: Ints,
    points: Floats,
    step: float,
    heights: Floats,
    triangles: Ints,
) -> None:
    """(T, 3, 3), …, (C + 1,), (N,), (P, 3) into (P,), (P,): the highest under each point.

    Corners and points have their height last. It is not higher than the point by more than a step;
    where there is none, the height is not a number and the triangle −1.
    """
    for point in range(points.shape[0]):
        x = math.floor((points[point, 0] - low[0]) / size[0])
        y = math.floor((points[point, 1] - low[1]) / size[1])
        heights[point] = math.nan
        triangles[point] = -1
        if 0 <= x < shape[0] and 0 <= y < shape[1]:
            cell = int(x) * shape[1] + int(y)
            for place in range(starts[cell], starts[cell + 1]):
                triangle = inside[place]
                height = _height(corners, triangle, points[point, 0], points[point, 1])
                if height <= points[point, 2] + step and not height <= heights[point]:
                    heights[point] = height
                    triangles[point] = triangle


@shared
def _cells(
    corners: Floats, triangle: int, axis: int, low: float, size: float, count: int
) -> tuple[int, int]:
    """Return the first and the last row of cells that a triangle lies over."""
    a, b, c = corners[triangle, 0, axis], corners[triangle, 1, axis], corners[triangle, 2, axis]
    first = math.floor((min(a, b, c) - low) / size - 1e-6)
    last = math.floor((max(a, b, c) - low) / size + 1e-6)
    return max(int(first), 0), min(int(last), count - 1)


@shared
def _height(corners: Floats, triangle: int, x: float, y: float) -> float:
    """Return the height of a triangle at a place, not a number where it is not."""
    ax, ay, az = corners[triangle, 0, 0], corners[triangle, 0, 1], corners[triangle, 0, 2]
    bx, by = corners[triangle, 1, 0] - ax, corners[triangle, 1, 1] - ay
    cx, cy = corners[triangle, 2, 0] - ax, corners[triangle, 2, 1] - ay
    area = bx * cy - by * cx
    if abs(area) < _FLAT:
        return math.nan
    u = ((x - ax) * cy - (y - ay) * cx) / area
    v = (bx * (y - ay) - by * (x - ax)) / area
    if u < -_BESIDE or v < -_BESIDE or u + v > 1.0 + _BESIDE:
        return math.nan
    return az + u * (corners[triangle, 1, 2] - az) + v * (corners[triangle, 2, 2] - az)
