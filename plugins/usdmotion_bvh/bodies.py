"""Where a body is and how large, in units of the file."""

import numpy as np

from usdmotion import Floats
from usdmotion.kernels import forward, world_points
from usdmotion_bvh.hierarchy import Hierarchy
from usdmotion_bvh.poses import Poses

_REACH_OVER_HEIGHT = 1.45
"""From the toes of a leg over the pelvis to the fingertips, over the standing height: 1.42 to 1.51
in a dozen skeletons of different makers, whatever pose they rest in."""


def body_height(hierarchy: Hierarchy) -> float:
    """Return about how tall a body stands, from the lengths of its segments alone.

    The longest way from one end of the skeleton to another is the same in every pose, which
    neither the rest pose of a file nor what somebody does in it is.
    """
    longest = [(0.0, 0.0)] * len(hierarchy.joints)

    def lengthen(joint: int, length: float) -> None:
        second, first = longest[joint]
        longest[joint] = (max(second, min(first, length)), max(first, length))

    for tip in hierarchy.tips:
        lengthen(tip.joint, float(np.linalg.norm(tip.offset)))
    for index in range(len(hierarchy.joints) - 1, 0, -1):
        joint = hierarchy.joints[index]
        lengthen(joint.parent, longest[index][1] + float(np.linalg.norm(joint.offset)))
    return max(sum(pair) for pair in longest) / _REACH_OVER_HEIGHT


def world_positions(hierarchy: Hierarchy, poses: Poses, translations: Floats) -> Floats:
    """Return where all joints, then all tips, are; shape (frame_count, joint + tip count, 3)."""
    positions, orientations = forward(poses.parents, translations, poses.rotations)
    if not hierarchy.tips:
        return positions
    joints = [tip.joint for tip in hierarchy.tips]
    offsets = np.array([tip.offset for tip in hierarchy.tips])
    tips = world_points(positions[:, joints], orientations[:, joints], offsets)
    return np.concatenate([positions, tips], axis=1)
