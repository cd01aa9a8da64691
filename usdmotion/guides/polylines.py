"""Polylines with as few points as look the same."""

import numpy as np

from usdmotion.arrays import Floats


def simplified(points: Floats, tolerance: float) -> Floats:
    """Return some of the points of a polyline, the ends among them (Douglas and Peucker 1973).

    Args:
        points: Shape (point_count, 3).
        tolerance: How far a point that is left out may be from what is left.

    Returns:
        Shape (kept_count, 3); one point where all are within the tolerance of the first.
    """
    if not (np.linalg.norm(points - points[0], axis=1) > tolerance).any():
        return points[:1]
    kept = np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    pieces = [(0, len(points) - 1)]
    while pieces:
        first, last = pieces.pop()
        if last - first < 2:
            continue
        distances = _from_segment(points[first + 1 : last], points[first], points[last])
        farthest = int(distances.argmax())
        if distances[farthest] > tolerance:
            middle = first + 1 + farthest
            kept[middle] = True
            pieces += [(first, middle), (middle, last)]
    return points[kept]


def _from_segment(points: Floats, start: Floats, end: Floats) -> Floats:
    """(N, 3), (3,), (3,) to (N,): how far points are from a segment."""
    along = end - start
    square = along @ along
    share = np.clip((points - start) @ along / square, 0.0, 1.0) if square > 0.0 else 0.0
    nearest = start + np.multiply.outer(share, along) if square > 0.0 else start
    return np.asarray(np.linalg.norm(points - nearest, axis=1))
