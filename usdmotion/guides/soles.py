"""What a foot leaves on the ground: an outline of its sole."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.guides.axes import sideways

_UNKNOWN = 0.12
"""Length of a foot of which one point is known, or that points straight down [m]."""
_HALF_WIDTH, _HEEL, _TOES = 0.22, 0.2, 0.25
"""Half the width of a sole, and how far its heel is behind the ankle and its toes are beyond the
ball, over the way from the one to the other."""
_LEAST = 0.05
"""Of a foot that is shorter than this from above, over its length, the way ahead is unknown."""
_CORNERS = 12
"""Of the outline about each point."""


def sole(points: Floats, up: Floats, height: float) -> Floats:
    """Return the outline of a sole, seen from above, flat at a height.

    Args:
        points: The ankle or the ball of a foot, then where its segments end [m], (point_count, 3).
        up: Away from the ground, shape (3,).
        height: Of the ground along it [m].

    Returns:
        Counterclockwise seen from above [m], shape (corner_count, 3).
    """
    from scipy.spatial import ConvexHull

    sides = np.stack(sideways(up))
    flat = points @ sides.T
    along = flat - flat[0]
    length = float(np.linalg.norm(along, axis=1).max())
    if length > _LEAST * float(np.linalg.norm(points - points[0], axis=1).max()):
        ahead = along[1:].mean(axis=0)
        flat = np.concatenate([flat, flat[:1] - _HEEL * ahead, flat[:1] + (1.0 + _TOES) * ahead])
    else:
        length = _UNKNOWN
    angles = np.linspace(0.0, 2.0 * np.pi, _CORNERS, endpoint=False)
    circle = _HALF_WIDTH * length * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    around = (flat[:, None] + circle).reshape(-1, 2)
    outline = around[ConvexHull(around).vertices]
    return np.asarray(outline @ sides + height * up)
