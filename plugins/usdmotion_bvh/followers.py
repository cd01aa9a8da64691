"""What the position channels of joints below the root mean."""

import numpy as np

from usdmotion import Bools, Floats
from usdmotion.kernels import forward
from usdmotion_bvh.hierarchy import Hierarchy
from usdmotion_bvh.poses import Poses
from usdmotion_bvh.source import Source

_CLEARLY = 0.5
"""A reading fits clearly better where its error is below this part of the other's."""


def leading(poses: Poses) -> Bools:
    """Return which joints carry the body through the room, shape (joint_count,).

    They have position channels, and no joint above them has any that is not all zeros: some
    exporters put an idle joint above the hips.
    """
    carries = np.any(poses.positions != 0.0, axis=(0, 2))
    carried = np.zeros(len(carries), dtype=np.bool_)
    for joint, parent in enumerate(poses.parents):
        carried[joint] = parent >= 0 and (carried[parent] or carries[parent])
    return _movable(poses) & ~carried


def following(poses: Poses) -> Bools:
    """Return which other joints have position channels, shape (joint_count,)."""
    return _movable(poses) & ~leading(poses)


def _movable(poses: Poses) -> Bools:
    movable: Bools = np.any(poses.moved, axis=1)
    return movable


def decide_followers(source: Source, hierarchy: Hierarchy, poses: Poses) -> tuple[str, list[str]]:
    """Return whether positions below the root are "absolute" or "relative" to OFFSET; "" for none.

    A joint keeps its distance from the joint above, whatever it does: the reading that keeps the
    length of OFFSET best is the right one.

    Raises:
        FileError: Positions in the world keep it better than either.
    """
    joints = np.flatnonzero(following(poses))
    if not len(joints) or not np.any(poses.offsets[joints]):
        return "", []
    lengths = np.linalg.norm(poses.offsets[joints], axis=1)
    above = _positions_above(poses)[:, joints]
    said = poses.positions[:, joints]
    readings = {
        "absolute": np.where(poses.moved, poses.positions, poses.offsets)[:, joints],
        "relative": said + poses.offsets[joints],
        "world": said - above,
    }
    errors = {
        name: float(np.mean(np.abs(np.linalg.norm(steps, axis=-1) - lengths)))
        for name, steps in readings.items()
    }
    local = "relative" if errors["relative"] < _CLEARLY * errors["absolute"] else "absolute"
    first = hierarchy.joints[joints[0]]
    if errors["world"] < _CLEARLY * errors[local]:
        says = f"the position channels of joint '{first.name}' are places in the world"
        cure = "export it with channels in the frame of the joint above"
        raise source.refusal(first.line, f"{says}, which would tear the body apart; {cure}")
    count = f"{len(joints)} joints below the root have position channels"
    meant = "added to their OFFSET" if local == "relative" else "taken instead of their OFFSET"
    return local, [f"{count}; they are {meant}, which keeps the lengths of the segments"]


def _positions_above(poses: Poses) -> Floats:
    """Return where the joint above each would be if position channels were places in the world."""
    local = np.where(poses.moved, poses.positions, poses.offsets)
    world, _ = forward(poses.parents, local, poses.rotations)
    places = np.where(np.all(poses.moved, axis=1, keepdims=True), poses.positions, world)
    above: Floats = places[:, np.maximum(poses.parents, 0)]
    return above
