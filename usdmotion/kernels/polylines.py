"""Which points of a polyline say how it goes."""

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Floats, Ints
from usdmotion.kernels.compiling import kernel, shared
from usdmotion.kernels.quaternions import Vector, vector_at


def telling(points: Floats, tolerance: float) -> NDArray[np.bool_]:
    """(N, 3) to (N,): which points are kept so that all are near the rest (Douglas and Peucker)."""
    kept = np.zeros(len(points), dtype=np.bool_)
    pieces = np.empty((len(points) + 1, 2), dtype=np.int64)
    _keep(np.ascontiguousarray(points), tolerance, pieces, kept)
    return kept


@kernel
def _keep(points: Floats, tolerance: float, pieces: Ints, kept: NDArray[np.bool_]) -> None:
    """(N, 3), tolerance, (N + 1, 2) as a stack, into (N,)."""
    kept[0] = kept[-1] = True
    pieces[0, 0], pieces[0, 1] = 0, points.shape[0] - 1
    waiting = 1
    while waiting:
        waiting -= 1
        first, last = pieces[waiting, 0], pieces[waiting, 1]
        start, end = vector_at(points, first), vector_at(points, last)
        farthest, middle = tolerance * tolerance, -1
        for index in range(first + 1, last):
            square = _beside(vector_at(points, index), start, end)
            if square > farthest:
                farthest, middle = square, index
        if middle >= 0:
            kept[middle] = True
            pieces[waiting, 0], pieces[waiting, 1] = first, middle
            pieces[waiting + 1, 0], pieces[waiting + 1, 1] = middle, last
            waiting += 2


@shared
def _beside(point: Vector, start: Vector, end: Vector) -> float:
    """Return the square of how far a point is from a segment."""
    ax, ay, az = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    px, py, pz = point[0] - start[0], point[1] - start[1], point[2] - start[2]
    square = ax * ax + ay * ay + az * az
    share = 0.0
    if square > 0.0:
        share = min(max((px * ax + py * ay + pz * az) / square, 0.0), 1.0)
    dx, dy, dz = px - share * ax, py - share * ay, pz - share * az
    return dx * dx + dy * dy + dz * dz
