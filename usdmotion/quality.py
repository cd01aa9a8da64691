"""How a motion moves, whatever was asked of it: jerk, standing feet and their slide, balance.

Arrays in, arrays out. Nothing depends on where the scene is or which way its axes point, and
lengths go in as metres.
"""

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels import world_points

SLOW = 0.12
"""A standing point is slower than this, in lengths of a leg per second."""
LOW = 0.2
"""The ankle of a standing foot is less than this above the lowest one, in lengths of a leg."""
SHORTEST = 0.1
"""A foot that stands for less than this does not stand [s]."""


def jerk(times: Floats, points: Floats) -> tuple[Floats, Floats]:
    """Return when and how hard points are jerked.

    It is the third derivative of the cubic through four neighbouring samples, however far they are
    apart: exact for a cubic.

    Args:
        times: Ascending [s], shape (frame_count,).
        points: Positions [m], shape (frame_count, …, 3).

    Returns:
        The middles of the four times, shape (frame_count − 3,), none of fewer than four frames; and
        the length of the jerk [m/s³], shape (frame_count − 3, …).
    """
    count = max(len(times) - 3, 0)
    windows = np.stack([times[start : start + count] for start in range(4)])
    total = np.zeros((count, *points.shape[1:]))
    for each in range(4):
        others = np.delete(windows, each, axis=0)
        share = 6.0 / np.prod(windows[each] - others, axis=0)
        total += share.reshape(-1, *[1] * (points.ndim - 1)) * points[each : each + count]
    return windows.mean(axis=0), np.linalg.norm(total, axis=-1)


def speed(times: Floats, points: Floats) -> Floats:
    """Return how fast points are [m/s]: (F,), (F, …, 3) to (F, …); nothing moves in one frame."""
    if len(times) < 2:
        return np.zeros(points.shape[:-1])
    return np.asarray(np.linalg.norm(np.gradient(points, times, axis=0), axis=-1))


def standing(
    times: Floats, points: Floats, ankles: Floats, feet: Ints, up: Floats, leg: float
) -> Bools:
    """Return when points of feet stand on something.

    A point stands while it is slow, as `SLOW` has it, for at least `SHORTEST`, on a foot whose
    ankle is near the height of the lowest one, as `LOW` has it. Where the ground is need not be
    known; it may have steps.

    Args:
        times: Ascending [s], shape (frame_count,).
        points: Points of feet [m], shape (frame_count, point_count, 3).
        ankles: The ankles [m], shape (frame_count, foot_count, 3).
        feet: The foot that each point belongs to, shape (point_count,).
        up: The direction away from the ground, shape (3,).
        leg: Length of a leg [m].

    Returns:
        Shape (frame_count, point_count).
    """
    heights = ankles @ up
    low = heights - heights.min(axis=1, keepdims=True) < LOW * leg
    stands = (speed(times, points) < SLOW * leg) & low[:, feet]
    for point in range(points.shape[1]):
        for first, end in runs(stands[:, point]):
            # A clip may begin or end in the middle of a step.
            inside = 0 < first and end < len(times)
            if inside and times[end - 1] - times[first] < SHORTEST:
                stands[first:end, point] = False
    return np.asarray(stands, dtype=np.bool_)


def runs(mask: Bools) -> list[tuple[int, int]]:
    """Return the stretches where a mask of shape (frame_count,) holds: first, and one past last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]])))
    return [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]


def along_ground(vectors: Floats, up: Floats) -> Floats:
    """Return vectors without what is along the up axis, (…, 3), (3,) to (…, 3)."""
    return np.asarray(vectors - (vectors @ up)[..., None] * up)


def slide(points: Floats, stands: Bools, up: Floats) -> Floats:
    """Return how far a point is, along the ground, from the middle of where it stands.

    Args:
        points: Positions [m], shape (frame_count, 3).
        stands: When it stands, shape (frame_count,).
        up: The direction away from the ground, shape (3,).

    Returns:
        Metres, shape (frame_count,); 0 where it does not stand.
    """
    found = np.zeros(len(points))
    flat = along_ground(points, up)
    for first, end in runs(stands):
        here = flat[first:end]
        found[first:end] = np.linalg.norm(here - here.mean(axis=0), axis=1)
    return found


def ground_height(positions: Floats, up: Floats) -> float:
    """Return about how high the ground is that somebody moves on [m].

    It is where the lowest of his joints seldom is beneath, so that a T-pose that hangs lower in the
    air than the captured steps does not count.

    Args:
        positions: Of the joints, world [m], shape (frame_count, joint_count, 3).
        up: The direction away from the ground, shape (3,).
    """
    return float(np.quantile((positions @ up).min(axis=1), 0.05))


def center_of_mass(
    positions: Floats, orientations: Floats, masses: Floats, centers: Floats
) -> Floats:
    """Return where the centre of mass is [m], shape (frame_count, 3).

    Args:
        positions: Of the joints, world [m], shape (frame_count, joint_count, 3).
        orientations: Of the joints, world, xyzw, shape (frame_count, joint_count, 4).
        masses: Of the joints, not all zero, shape (joint_count,).
        centers: Of those masses in their joints' frames [m], shape (joint_count, 3).
    """
    heavy = masses > 0.0
    points = world_points(positions[:, heavy], orientations[:, heavy], centers[heavy])
    return np.asarray(np.einsum("j,fji->fi", masses[heavy] / masses.sum(), points))
