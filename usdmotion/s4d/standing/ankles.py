"""Ankles that can be bent so far and no farther, whatever the ground is like."""

from typing import NamedTuple

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, limit_boxes, multiply, rotate, within_limits
from usdmotion.kernels.limits import limited_vectors
from usdmotion.motion import Body, Skeleton
from usdmotion.s4d.standing.legs import LEFT, Leg, Pose, flexion
from usdmotion.s4d.turns import about

UPWARD, DOWNWARD = 30.0, 45.0
"""How far most people bend an ankle up from standing, and down [degrees]."""


class Foot(NamedTuple):
    """Where a foot is to be."""

    ankle: Floats
    """In the world [m], shape (frame_count, 3)."""
    turn: Floats
    """World orientation of the ankle joint, xyzw, shape (frame_count, 4)."""
    toes: Floats
    """By what the toes are turned in the world, xyzw, shape (frame_count, 4)."""


def held_back(
    leg: Leg,
    pose: Pose,
    skeleton: Skeleton,
    body: Body | None,
    shank: Floats,
    foot: Foot,
    up: Floats,
) -> Foot:
    """Return a foot as far as its ankle can be bent.

    What is authored as the limits of the ankle counts; without any, what most people can do. A
    motion that goes farther by itself may go as far as it does. Where the foot cannot lie on what
    rises before it, its heel leaves the ground; where it cannot on what falls, its ball does.

    Args:
        leg: Which.
        pose: The motion as it was.
        skeleton: Its joints.
        body: Their limits; None is none.
        shank: By what the shank is turned in the world, xyzw, shape (frame_count, 4).
        foot: Where the foot is to be.
        up: The direction away from the ground, shape (3,).
    """
    if body is not None and _is_limited(body, leg.ankle):
        turn = _as_authored(leg, pose, skeleton, body, shank, foot.turn)
    else:
        turn = _as_people(leg, pose, shank, foot.turn)
    ball = leg.ball_in_foot(pose)
    about_ball = foot.ankle + rotate(foot.turn, ball) - rotate(turn, ball)
    rises = (about_ball - foot.ankle) @ up > 0.0
    return Foot(np.where(rises[:, None], about_ball, foot.ankle), turn, foot.toes)


def _is_limited(body: Body, joint: int) -> bool:
    return bool(np.abs([body.limits_min[joint], body.limits_max[joint]]).min() < 180.0)


def _as_people(leg: Leg, pose: Pose, shank: Floats, turn: Floats) -> Floats:
    was = flexion(leg, pose.rotations[:, leg.knee], pose.rotations[:, leg.ankle])
    now = flexion(leg, multiply(shank, pose.rotations[:, leg.knee]), turn)
    lowest = np.minimum(was, np.radians(-DOWNWARD))
    highest = np.maximum(was, np.radians(UPWARD))
    # About the axis to its left a foot turns down.
    less = about(LEFT, now - np.clip(now, lowest, highest))
    return multiply(turn, multiply(leg.foot, multiply(less, conjugate(leg.foot))))


def _as_authored(
    leg: Leg, pose: Pose, skeleton: Skeleton, body: Body, shank: Floats, turn: Floats
) -> Floats:
    above = pose.rotations[:, int(skeleton.parents[leg.ankle])]
    low, high = limit_boxes(body.limits_min[leg.ankle], body.limits_max[leg.ankle])
    rest = skeleton.rest_rotations[leg.ankle]
    own = multiply(conjugate(above), pose.rotations[:, leg.ankle])
    was = limited_vectors(own, rest, low, high)
    carrier = multiply(shank, above)
    wanted = multiply(conjugate(carrier), turn)
    box = np.minimum(low, was), np.maximum(high, was)
    return multiply(carrier, within_limits(wanted, rest, *box))
