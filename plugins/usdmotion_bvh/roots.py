"""Whether the position channels of the root include its OFFSET or are a difference from it."""

import numpy as np

from usdmotion import Bools, Floats
from usdmotion_bvh.bodies import world_positions
from usdmotion_bvh.followers import following, leading
from usdmotion_bvh.hierarchy import Hierarchy
from usdmotion_bvh.poses import Poses

_SMALL = 1e-3
"""An OFFSET below this part of the height is not worth a word."""
_CLEARLY = 0.5
"""A rule is right where it leaves less than this part of what the other leaves."""


def local_translations(poses: Poses, relative: Bools) -> Floats:
    """Return translations of all joints: channels take the place of OFFSET or are added to it."""
    said = poses.positions + np.where(relative[:, None], poses.offsets, 0.0)
    return np.where(poses.moved, said, poses.offsets)


def decide_root(
    hierarchy: Hierarchy, poses: Poses, height: float, axis: int, followers: str, wished: str
) -> tuple[str, list[str]]:
    """Return whether the root's positions are "absolute" or "relative", and why.

    Args:
        hierarchy: The joints.
        poses: What their channels say.
        height: About how tall the body stands.
        axis: The axis that points up.
        followers: How positions below the root are meant; "" where there are none.
        wished: What overrules the data, or "auto".
    """
    if wished != "auto":
        return wished, []
    leaders = leading(poses)
    offsets = np.where(poses.moved, poses.offsets, 0.0)[leaders]
    if not np.any(np.abs(offsets) > _SMALL * height):
        return "absolute", []
    rule, why = (
        _by_floor(hierarchy, poses, axis, followers)
        or _by_followers(followers)
        or _by_repetition(poses.positions[:, leaders], offsets)
        or ("absolute", "most files are so and nothing tells; the option root overrules it")
    )
    how = "taking the place of its OFFSET" if rule == "absolute" else "differences from its OFFSET"
    name = hierarchy.joints[int(np.argmax(leaders))].name
    return rule, [f"positions of joint '{name}' are read as {how}: {why}"]


def _by_floor(
    hierarchy: Hierarchy, poses: Poses, axis: int, followers: str
) -> tuple[str, str] | None:
    """Judge by the floor, to which feet come down by the right rule only."""
    leaders, below = leading(poses), following(poses) & (followers == "relative")
    low = {
        rule: _lowest(world_positions(hierarchy, poses, local_translations(poses, joints)), axis)
        for rule, joints in (("absolute", below), ("relative", below | leaders))
    }
    rule, other = sorted(low, key=lambda each: abs(low[each]))
    if abs(low[rule]) >= _CLEARLY * abs(low[other]):
        return None
    return rule, f"the body then comes down to {low[rule]:.4g} units, else to {low[other]:.4g}"


def _lowest(points: Floats, axis: int) -> float:
    """Return how low the body comes, without the lowest frames: they may be faults."""
    return float(np.percentile(points[..., axis].min(axis=1), 10.0))


def _by_followers(followers: str) -> tuple[str, str] | None:
    return (followers, "those of the joints below it are") if followers else None


def _by_repetition(positions: Floats, offsets: Floats) -> tuple[str, str] | None:
    """Judge by what positions stay near to: the OFFSET itself, or nothing."""
    from_offset = float(np.median(np.linalg.norm(positions - offsets, axis=-1)))
    from_nothing = float(np.median(np.linalg.norm(positions, axis=-1)))
    if from_offset < _CLEARLY * from_nothing:
        return "absolute", "they stay near to it"
    if from_nothing < _CLEARLY * from_offset:
        return "relative", "they stay near to zero"
    return None
