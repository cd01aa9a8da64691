"""Polylines with as few points as look the same."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import telling


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
    return points[telling(points, tolerance)]
