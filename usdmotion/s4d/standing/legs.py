"""Legs in closed form: where the knee is when hip and ankle are elsewhere (2005, sections 4, 7)."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.humanoid.parts import ANKLE, BALL, LEG
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.s4d.bodies import Morphology
from usdmotion.s4d.limbs import middle_of
from usdmotion.s4d.standing.soles import Sole
from usdmotion.s4d.turns import across, swing, unit

LEFT, UP, FRONT = np.eye(3)
"""The axes of a canonical frame."""
STRAIGHT = 0.995
"""How far a leg is stretched at most, over its length, if the motion itself does not do more."""


_SAME = 1e-6
"""A leg whose length changes by no more than this goes as it went [m]."""
_OVERSTRETCHED = 0.12
"""So far behind the line from hip to ankle, over the thigh, a knee is overstretched; one twice as
far is bent, wherever it points."""
_FOOT = 0.146
"""From ankle to ball over leg length, where a foot has no ball (as the demonstrations' body)."""
_HEEL, _TOES = 0.55, 0.62
"""How far a heel is behind the ankle, and toes are before the ball, in lengths from ankle to ball
(likewise)."""


class Pose(NamedTuple):
    """Where all joints are in the world."""

    positions: Floats
    """Shape (frame_count, joint_count, 3) [m]."""
    rotations: Floats
    """Shape (frame_count, joint_count, 4), xyzw."""


@dataclass(frozen=True, eq=False)
class Leg:
    """The joints of one leg."""

    side: str
    """"l" or "r"."""
    hip: int
    knee: int
    ankle: int
    ball: int | None
    """The joint of the toes; None where there is none."""
    thigh: Floats
    """The canonical frame of the thigh in the frame of the hip joint, xyzw, shape (4,)."""
    shank: Floats
    """That of the shank in the frame of the knee."""
    foot: Floats
    """That of the foot in the frame of the ankle."""
    length: float
    """From ankle to ball, along the ground at rest [m]."""

    @classmethod
    def of(cls, morphology: Morphology, side: str) -> "Leg":
        """Return a leg of a body."""
        names = [f"{side}_{part}" for part in LEG[:3]]
        hip, knee, ankle = map(morphology.joint, names)
        thigh, shank, foot = map(morphology.canonical, names)
        ball = morphology.parts.joint(f"{side}_{LEG[3]}")
        length = _FOOT * morphology.leg_length
        if ball is not None:
            places, up = morphology.rest_positions, rotate(morphology.axes, UP)
            way = places[ball] - places[ankle]
            length = max(float(np.linalg.norm(way - (way @ up) * up)), 1e-3)
        return cls(side, hip, knee, ankle, ball, thigh, shank, foot, length)

    def sole_from(self, joint: int) -> Sole:
        """Return the underside of the foot, as seen from its ankle or its ball."""
        back, front = (_HEEL, 1.0) if joint == self.ankle else (1.0 + _HEEL, 0.0)
        return Sole(back * self.length, front * self.length)

    def sole_points(self, over: dict[str, float]) -> Floats:
        """Return heel, ball and tip of the sole in the frame of the ankle [m], shape (3, 3).

        Args:
            over: How high ankles and balls are over the sole.
        """
        ahead = self.length * np.array((-_HEEL, 1.0, 1.0 + _TOES))
        return rotate(self.foot, ahead[:, None] * FRONT - over[ANKLE] * UP)

    def ball_in_foot(self, pose: Pose) -> Floats:
        """Return where the ball of the foot is in the frame of the ankle [m], shape (F, 3)."""
        if self.ball is None:
            return np.broadcast_to(rotate(self.foot, self.length * FRONT), (len(pose.positions), 3))
        way = pose.positions[:, self.ball] - pose.positions[:, self.ankle]
        return rotate(conjugate(pose.rotations[:, self.ankle]), way)

    @property
    def stands_on(self) -> int:
        """The joint that its footprints are of."""
        return self.ankle if self.ball is None else self.ball

    @property
    def stands_by(self) -> str:
        """The name of that joint, without its side."""
        return ANKLE if self.ball is None else BALL

    def lengths(self, pose: Pose) -> tuple[Floats, Floats, Floats]:
        """Return the lengths of thigh and shank and the distance from hip to ankle, (F,) each."""
        hip, knee, ankle = (pose.positions[:, j] for j in (self.hip, self.knee, self.ankle))
        pairs = ((hip, knee), (knee, ankle), (hip, ankle))
        thigh, shank, whole = (np.linalg.norm(b - a, axis=1) for a, b in pairs)
        return thigh, shank, whole

    def reach(self, pose: Pose) -> Floats:
        """Return how far from the hip the ankle may be [m], shape (F,)."""
        thigh, shank, whole = self.lengths(pose)
        return np.maximum(STRAIGHT * (thigh + shank), whole)

    def heading(self, rotations: Floats, up: Floats) -> Floats:
        """Return where the foot points along the ground, (F, J, 4) to (F, 3)."""
        ahead = rotate(multiply(rotations[:, self.ankle], self.foot), FRONT)
        return unit(across(ahead, up))


def bent(leg: Leg, pose: Pose, hip: Floats, ankle: Floats) -> tuple[Floats, Floats]:
    """Return how thigh and shank are turned so that a leg goes from a hip to an ankle.

    The half-plane of the knee goes along with the way from hip to ankle; what the leg is bent more
    than it was, it is bent by its anatomical hinge, so that a straight one bends forward.

    Args:
        leg: Which.
        pose: Where it was.
        hip: Where its hip is now [m], shape (frame_count, 3).
        ankle: Where its ankle is to be; out of reach it is come as near as can be.

    Returns:
        Rotations in the world, xyzw, by which the thigh, and by which the shank, is turned,
        shape (frame_count, 4) each.
    """
    before = pose.positions[:, leg.ankle] - pose.positions[:, leg.hip]
    z = unit(ankle - hip)
    carried = swing(unit(before), z)
    upper, lower = (
        rotate(carried, pose.positions[:, b] - pose.positions[:, a])
        for a, b in ((leg.hip, leg.knee), (leg.knee, leg.ankle))
    )
    a, b, _ = leg.lengths(pose)
    most = np.maximum(a + b, np.linalg.norm(before, axis=1))
    d = np.clip(np.linalg.norm(ankle - hip, axis=1), np.abs(a - b) + 1e-6, most - 1e-12)
    along, aside = middle_of(a, b, d)
    was = across(upper, z)
    front = rotate(multiply(pose.rotations[:, leg.hip], leg.thigh), FRONT)
    hinge = unit(across(rotate(carried, front), z))
    more = np.maximum(aside - np.linalg.norm(was, axis=1), 0.0)
    if np.abs(d - np.linalg.norm(before, axis=1)).max(initial=0.0) > _SAME:
        # Who overstretches a knee a little must not have it snap to and fro when legs are bent.
        little = np.clip(2.0 - np.linalg.norm(was, axis=1) / (_OVERSTRETCHED * a), 0.0, 1.0)
        more += 2.0 * little * np.maximum(-np.sum(was * hinge, axis=1), 0.0)
    y = unit(was + more[:, None] * hinge)
    knee = along[:, None] * z + aside[:, None] * y
    end = d[:, None] * z
    return (
        multiply(swing(unit(upper), unit(knee)), carried),
        multiply(swing(unit(lower), unit(end - knee)), carried),
    )


def flexion(leg: Leg, shanks: Floats, feet: Floats) -> Floats:
    """Return how far the ankle is bent up from rest [rad], shape (frame_count,).

    Args:
        leg: Which.
        shanks: World orientation of the knee joint, xyzw, shape (frame_count, 4).
        feet: That of the ankle joint.
    """
    ahead = rotate(multiply(feet, leg.foot), FRONT)
    inside = rotate(conjugate(multiply(shanks, leg.shank)), ahead)
    return np.asarray(np.arctan2(inside @ UP, inside @ FRONT))
