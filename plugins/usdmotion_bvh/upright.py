"""Which axis of a file points up."""

from typing import Literal

import numpy as np

from usdmotion.arrays import Floats
from usdmotion_bvh.bodies import world_positions
from usdmotion_bvh.hierarchy import Hierarchy
from usdmotion_bvh.poses import Poses

Up = Literal["Y", "Z"]
AXIS = {"Y": 1, "Z": 2}
_CLEARLY = 1.25


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
    rest = np.ptp(_resting(hierarchy, poses), axis=0)
    floor = np.subtract(*np.percentile(points.min(axis=1), (95.0, 5.0), axis=0))
    votes = 1.5 * _larger(extents) + _larger(rest) - _flatter(floor, height)
    up: Up = "Z" if votes > 0.0 else "Y"
    if up == "Y" and extents[1] > _CLEARLY * extents[2]:
        return up, []
    other = "Y" if up == "Z" else "Z"
    tall, deep = extents[AXIS[up]], extents[AXIS[other]]
    found = f"the body is typically {tall:.4g} units tall along {up}, {deep:.4g} along {other}"
    return up, [f"{up} is read as up: {found}"]


def _resting(hierarchy: Hierarchy, poses: Poses) -> Floats:
    still = Poses(
        poses.parents,
        poses.offsets,
        poses.positions[:1],
        poses.moved,
        np.tile((0.0, 0.0, 0.0, 1.0), (1, len(poses.parents), 1)),
    )
    points: Floats = world_positions(hierarchy, still, poses.offsets[None])[0]
    return points


def _larger(extents: Floats) -> float:
    """Return 1 where Z is clearly the larger one, -1 where Y is, 0 between."""
    if extents[2] > _CLEARLY * extents[1]:
        return 1.0
    return -1.0 if extents[1] > _CLEARLY * extents[2] else 0.0


def _flatter(spread: Floats, height: float) -> float:
    """Return 1 where the lowest point stays the same along Y but not along Z, -1 the other way."""
    flat, far = spread < 0.1 * height, spread > 0.5 * height
    return float(flat[1] and far[2]) - float(flat[2] and far[1])
