"""The columns of a motion made into local translations and rotations, in units of the file."""

import itertools
from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from usdmotion import Bools, Floats, Ints
from usdmotion_bvh.hierarchy import Hierarchy

_Turns = defaultdict[tuple[int, ...], list[tuple[int, list[int]]]]
"""Joints with their columns of angles, by the axes those turn about."""


@dataclass(frozen=True, eq=False)
class Poses:
    """What the channels say, before it is decided how positions are meant."""

    parents: Ints
    """Index of each joint's parent, shape (joint_count,)."""
    offsets: Floats
    """OFFSET of each joint, shape (joint_count, 3)."""
    positions: Floats
    """What position channels say, 0 without, shape (frame_count, joint_count, 3)."""
    moved: Bools
    """Which coordinates have a position channel, shape (joint_count, 3)."""
    rotations: Floats
    """Local rotations, unit xyzw, shape (frame_count, joint_count, 4)."""


def read_poses(hierarchy: Hierarchy, values: Floats) -> Poses:
    """Sort the columns of a motion by joint; angles become quaternions."""
    joint_count, frame_count = len(hierarchy.joints), len(values)
    positions = np.zeros((frame_count, joint_count, 3))
    moved = np.zeros((joint_count, 3), dtype=bool)
    turns: _Turns = defaultdict(list)
    columns = itertools.count()
    for index, joint in enumerate(hierarchy.joints):
        angles: list[int] = []
        for channel in joint.channels:
            column = next(columns)
            if channel.turns:
                angles.append(column)
            else:
                positions[:, index, channel.axis] = values[:, column]
                moved[index, channel.axis] = True
        axes = tuple(channel.axis for channel in joint.channels if channel.turns)
        turns[axes].append((index, angles))
    rotations = np.zeros((frame_count, joint_count, 4))
    for axes, joints in turns.items():
        sorted_out = np.array([angles for _, angles in joints], dtype=np.int64)
        turned = _rotations(axes, np.radians(values[:, sorted_out]))
        rotations[:, [index for index, _ in joints]] = turned
    return Poses(
        np.array([joint.parent for joint in hierarchy.joints]),
        np.array([joint.offset for joint in hierarchy.joints]),
        positions,
        moved,
        rotations,
    )


def _rotations(axes: tuple[int, ...], angles: Floats) -> Floats:
    """(A,), (F, J, A) to (F, J, 4): turns about the axes, each in the frame the last one left.

    A position channel between or after them makes no difference: the translation of a joint is
    in its parent's frame wherever its channels stand.
    """
    turned = np.zeros((*angles.shape[:2], 4))
    turned[..., 3] = 1.0
    for position, axis in enumerate(axes):
        sine, cosine = np.sin(0.5 * angles[..., position]), np.cos(0.5 * angles[..., position])
        second, third = (axis + 1) % 3, (axis + 2) % 3
        old = turned.copy()
        turned[..., axis] = cosine * old[..., axis] + sine * old[..., 3]
        turned[..., second] = cosine * old[..., second] + sine * old[..., third]
        turned[..., third] = cosine * old[..., third] - sine * old[..., second]
        turned[..., 3] = cosine * old[..., 3] - sine * old[..., axis]
    return turned
