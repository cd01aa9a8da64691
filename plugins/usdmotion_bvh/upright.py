"""Which axis of a file points up."""

import dataclasses
from typing import Literal

import numpy as np

from usdmotion import Floats
from usdmotion_bvh.bodies import world_positions
from usdmotion_bvh.hierarchy import Hierarchy
from usdmotion_bvh.poses import Poses

Up = Literal["Y", "Z"]
AXIS = {"Y": 1, "Z": 2}
_CLEARLY = 1.25
"""One extent is larger than another by this factor at least."""
_TALL = 0.4
"""Part of the height that a body has from bottom to top even when it sits."""


def decide_up(
    hierarchy: Hierarchy, poses: Poses, points: Floats, height: float, wished: str
) -> tuple[Up, list[str]]:
    """Return the axis that points up, by a vote of three unless it is wished for.

    A body is mostly taller than deep, a floor is flat while the body travels, and most skeletons
    rest standing. A person who crawls defies the first, a climber the second, skeletons whose
    segments all rest along one axis the third.
    """
    if wished != "auto":
        return ("Z" if wished == "Z" else "Y"), []
    extents = np.median(np.ptp(points, axis=1), axis=0)
    floor = np.subtract(*np.percentile(points.min(axis=1), (95.0, 5.0), axis=0))
    # Who lies along X is tall along neither.
    tall = extents[1:].max() > _TALL * height
    votes = 1.5 * tall * _larger(extents) + _resting(hierarchy, poses) + _flatter(floor, height)
    up: Up = "Z" if votes > 0.0 else "Y"
    if up == "Y" and extents[1] > _CLEARLY * extents[2]:
        return up, []
    other = "Y" if up == "Z" else "Z"
    tall, deep = (f"{extents[AXIS[axis]]:.4g} units along {axis}" for axis in (up, other))
    return up, [f"{up} is read as up: the body typically extends {tall}, {deep}"]


def _resting(hierarchy: Hierarchy, poses: Poses) -> float:
    """Return 1 where the rest pose is taller along Z, -1 where it is along Y, 0 between.

    The arms of a T-pose reach as far as the body is tall, but alike to both sides.
    """
    identity = np.tile((0.0, 0.0, 0.0, 1.0), (1, len(poses.parents), 1))
    still = dataclasses.replace(poses, rotations=identity)
    points = world_positions(hierarchy, still, poses.offsets[None])[0]
    ordered = np.sort(points - 0.5 * (points.min(axis=0) + points.max(axis=0)), axis=0)
    lopsided = np.mean(np.abs(ordered + ordered[::-1]), axis=0)
    return _larger(np.ptp(points, axis=0)) or _larger(lopsided)


def _larger(extents: Floats) -> float:
    """Return 1 where Z is clearly the larger one, -1 where Y is, 0 between."""
    if extents[2] > _CLEARLY * extents[1]:
        return 1.0
    return -1.0 if extents[1] > _CLEARLY * extents[2] else 0.0


def _flatter(spread: Floats, height: float) -> float:
    """Return 1 where the lowest point stays the same along Z but not along Y, -1 the other way."""
    flat, far = spread < 0.1 * height, spread > 0.5 * height
    return float(flat[2] and far[1]) - float(flat[1] and far[2])
