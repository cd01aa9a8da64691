"""Directions beside an axis, and a marker that is seen from every side."""

import numpy as np

from usdmotion.arrays import Floats, Ints

OCTAHEDRON_FACES: Ints = np.array(
    [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
)
"""Corners of its faces, counterclockwise seen from outside, shape (8, 3)."""


def octahedron(radius: float) -> Floats:
    """Return its corners about the origin, shape (6, 3): both ways along x, y and z."""
    return np.asarray(np.repeat(np.eye(3), 2, axis=0) * np.tile([radius, -radius], 3)[:, None])


def sideways(up: Floats) -> tuple[Floats, Floats]:
    """Return two directions, at right angles to a third and to each other, right-handed with it."""
    other = np.eye(3)[np.abs(up).argmin()]
    first = np.cross(other, up)
    first /= np.linalg.norm(first)
    return first, np.cross(up, first)
