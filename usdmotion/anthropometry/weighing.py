"""Masses of joints: each weighs what is rigidly moved by it and by no joint below."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, cast

import numpy as np

from usdmotion.anthropometry import segments as table
from usdmotion.anthropometry.rest_pose import RestPose
from usdmotion.anthropometry.segments import Segment
from usdmotion.arrays import Floats
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG, finger, toe
from usdmotion.motion import Body, Skeleton

MassSource = Literal["authored", "anthropometric table", "segment lengths"]
"""Where masses are from: the stage, de Leva's table, or the lengths between the joints."""

_NEAR = 0.05
"""Share of the trunk below which two joints are too near to each other to tell a direction."""


def with_masses(
    skeleton: Skeleton, body: Body, parts: PartMap | None = None
) -> tuple[Body, MassSource]:
    """Return a body that weighs something, and where that is from.

    Masses that a body has are kept. Else they are from the table, where it is known which joint is
    which, else from the lengths between the joints, and sum to 1.

    Args:
        skeleton: Its rest pose says how long the segments are.
        body: What is known of it.
        parts: Which joint is which part; None where that is not known.
    """
    if (body.masses > 0.0).any():
        return body, "authored"
    pose = None if parts is None or parts.missing else RestPose(skeleton, parts)
    if pose is not None and pose.is_whole:
        return _weighing(body, _by_table(pose)), "anthropometric table"
    return _weighing(body, _by_length(skeleton)), "segment lengths"


@dataclass(frozen=True, slots=True)
class _Mass:
    """Some mass on a joint."""

    joint: int
    mass: float
    center: Floats
    """In the frame of the joint [m], shape (3,)."""


def _weighing(body: Body, masses: Sequence[_Mass]) -> Body:
    total = np.zeros(len(body.masses))
    moments = np.zeros((len(total), 3))
    for each in masses:
        total[each.joint] += each.mass
        moments[each.joint] += each.mass * each.center
    weighs = total > 0.0
    moments[weighs] /= total[weighs, None]
    return replace(body, masses=total / total.sum(), mass_centers=moments)


def _by_length(skeleton: Skeleton) -> list[_Mass]:
    """Return masses as if all segments were equally thick rods from joint to joint."""
    lengths = np.linalg.norm(skeleton.rest_translations, axis=1)
    masses = [
        _Mass(int(parent), float(lengths[joint]), 0.5 * skeleton.rest_translations[joint])
        for joint, parent in enumerate(skeleton.parents)
        if parent >= 0 and lengths[joint] > 0.0
    ]
    return masses or [_Mass(0, 1.0, np.zeros(3))]


def _by_table(pose: RestPose) -> list[_Mass]:
    masses = [*_trunk(pose), *_head(pose)]
    for side in "lr":
        for (top, end), segment in table.LIMBS.items():
            masses += _limb(pose, pose.way(f"{side}_{top}", f"{side}_{end}"), segment)
        masses += [_hand(pose, side), _foot(pose, side)]
    return masses


def _limb(pose: RestPose, way: Sequence[int], segment: Segment) -> list[_Mass]:
    """Spread a segment over the joints on its way; twist joints beside it get nothing."""
    total, place, masses = pose.length(way), 0.0, []
    for joint, below in pairwise(way):
        share = pose.distance(joint, below) / total
        if share > 0.0:
            line = pose.seen(joint, below) / share
            masses += _cut(joint, [segment], (place, place + share), -place * line, line)
        place += share
    return masses


def _cut(
    joint: int, cut: Sequence[Segment], span: tuple[float, float], origin: Floats, line: Floats
) -> list[_Mass]:
    """Return what is between two places of segments, whose line is `origin + place * line`."""
    pieces = [segment.cut(*span) for segment in cut]
    return [
        _Mass(joint, mass, origin + moment / mass * line) for mass, moment in pieces if mass > 0.0
    ]


def _trunk(pose: RestPose) -> list[_Mass]:
    """Spread the trunk over pelvis and back.

    The pelvis has the lower trunk, and what is below the first vertebra.
    """
    back, places, up = _back(pose)
    middle, total = _between_hips(pose), places[-1]
    upper = [table.MIDDLE_TRUNK, table.UPPER_TRUNK]
    pelvis, line = back[0], total * up
    masses = _cut(pelvis, [table.LOWER_TRUNK], (0.0, 1.0), middle, line)
    masses += _cut(pelvis, upper, (0.0, places[1] / total), middle, line)
    for step in range(1, len(back) - 1):
        low, high = places[step] / total, places[step + 1] / total
        if high > low:
            line = total * pose.seen(back[step], back[step + 1])
            line /= pose.distance(back[step], back[step + 1])
            masses += _cut(back[step], upper, (low, high), -low * line, line)
    return masses


def _between_hips(pose: RestPose) -> Floats:
    """Return the middle between the hip joints in the frame of the pelvis [m]."""
    pelvis = pose.parts.joint("humanoid_root")
    hips = [pose.parts.joint(f"{side}_hip") for side in "lr"]
    assert pelvis is not None
    seen = [pose.seen(pelvis, hip) for hip in hips if hip is not None]
    return cast(Floats, np.mean(seen, axis=0))


def _back(pose: RestPose) -> tuple[list[int], Floats, Floats]:
    """Return the joints from pelvis to neck, how high they are [m], and up as the pelvis sees it.

    Heights are along the back, from between the hips on.
    """
    column = pose.way("humanoid_root", "skullbase")
    chest = column.index(pose.parts.spine[-1])
    # A neck may begin at the very place of the chest.
    neck = next(
        (j for j in column[chest + 1 :] if pose.distance(column[chest], j) > 0.0), column[-1]
    )
    back = [*column[: chest + 1], neck]
    near = _NEAR * pose.length(back)
    middle = _between_hips(pose)
    seen = np.array([pose.seen(back[0], joint) for joint in back])
    apart = np.minimum(np.linalg.norm(seen, axis=1), np.linalg.norm(seen - middle, axis=1))
    sure = int(np.argmax(apart > near)) or int(np.argmax(apart))
    up = (seen[sure] - middle) / np.linalg.norm(seen[sure] - middle)
    heights = np.zeros(len(back))
    heights[: sure + 1] = (seen[: sure + 1] - middle) @ up
    for step in range(sure + 1, len(back)):
        heights[step] = heights[step - 1] + pose.distance(back[step - 1], back[step])
    if neck == column[-1]:
        heights[-1] -= min(table.NECK_BELOW * pose.leg, 0.5 * (heights[-1] - heights[-2]))
    return back, np.maximum.accumulate(np.maximum(heights, 0.0)), up


def _head(pose: RestPose) -> list[_Mass]:
    head = pose.parts.joint("skullbase")
    assert head is not None
    center = table.HEAD_BEYOND * pose.leg * pose.onward(head)
    return [_Mass(head, table.HEAD_MASS, center)]


def _hand(pose: RestPose, side: str) -> _Mass:
    """Return the mass of a hand with its fingers."""
    wrist = pose.parts.joint(f"{side}_radiocarpal")
    assert wrist is not None
    knuckle = pose.parts.joint(f"{side}_{finger(3)[1]}")
    if knuckle is None:
        center = table.HAND_BEYOND * pose.leg * pose.onward(wrist)
    else:
        center = table.HAND_CENTER * pose.seen(wrist, knuckle)
    return _Mass(wrist, table.HAND_MASS, center)


def _foot(pose: RestPose, side: str) -> _Mass:
    """Return the mass of a foot with its toes; it is at the ankle where nothing shows the foot."""
    ankle = pose.parts.joint(f"{side}_{LEG[2]}")
    assert ankle is not None
    whole = pose.parts.joint(f"{side}_{LEG[3]}")
    balls = [pose.parts.joint(f"{side}_{toe(digit)[1]}") for digit in range(1, 6)]
    seen = [pose.seen(ankle, ball) for ball in ([whole] if whole is not None else balls) if ball]
    center = table.FOOT_CENTER * np.mean(seen, axis=0) if seen else np.zeros(3)
    return _Mass(ankle, table.FOOT_MASS, center)
