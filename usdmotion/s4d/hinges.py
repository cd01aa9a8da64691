"""Knees and elbows with limits, which another body's may not bend within.

Bodies agree on where their arms and legs are, and not on how they are rolled in the pose in which
they rest: one's elbow bends to the front there, another's a little upwards too, with the forearm
turned in. On a body whose joint is a hinge, the segments above and below it have to be rolled.
"""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import beyond_limits, conjugate, limit_boxes, multiply, to_vector
from usdmotion.motion import Body, Motion
from usdmotion.s4d.bodies import Limb, Morphology
from usdmotion.s4d.turns import about, unit

_FREE = 90.0
"""Range of a joint sideways that makes it no hinge [degrees]."""
_WITHIN = np.radians(0.5)
"""How far beyond what rolling can do at most a joint may stay [rad]: where it can do nothing, as
for an overstretched knee, nothing is rolled, and nothing jumps where that begins."""
_SIDEWAYS = np.radians(40.0)
"""How near to a bend to the side it is no longer made one about the hinge [rad]."""
_HALVINGS = 12
"""How often the share of the way to the hinge is halved to find how much of it is needed."""


def hinged(motion: Motion, morphology: Morphology, body: Body) -> Motion:
    """Return a motion whose knees and elbows bend within their limits, as far as rolling does it.

    The segments above and below are rolled about themselves, no further than it takes: all joints
    stay where they are, hands and feet are turned as they were, and what is within its limits is
    left alone.

    Args:
        motion: Of the morphology's skeleton.
        morphology: The body that moves.
        body: How far its joints turn.
    """
    rotations, parents = np.array(motion.rotations), morphology.skeleton.parents
    for limb in morphology.limbs:
        limits = body.limits_min[limb.middle], body.limits_max[limb.middle]
        # Where other joints are between, the limits are not those of the bend.
        if parents[limb.middle] == limb.top and parents[limb.end] == limb.middle:
            _roll(rotations, morphology, limb, limits)
    return Motion(motion.times, motion.translations, rotations)


def _roll(
    rotations: Floats, morphology: Morphology, limb: Limb, limits: tuple[Floats, Floats]
) -> None:
    """Roll the two segments of a limb, (F, J, 4)."""
    ways = [unit(morphology.skeleton.rest_translations[joint]) for joint in (limb.middle, limb.end)]
    hinge = _hinge(ways[1], limits)
    if hinge is None:
        return
    rest, now = morphology.skeleton.rest_rotations[limb.middle], rotations[:, limb.middle]
    rolls = _to_hinge(rest, now, ways, hinge)
    boxes = limit_boxes(*limits)

    def rolled(share: Floats) -> tuple[Floats, Floats]:
        upper, lower = (about(way, share * roll) for way, roll in zip(ways, rolls, strict=True))
        return upper, lower

    def beyond(share: Floats) -> Floats:
        upper, lower = rolled(share)
        return beyond_limits(multiply(multiply(conjugate(upper), now), lower), rest, *boxes)

    low, high = np.zeros(len(now)), np.ones(len(now))
    best = beyond(high) + _WITHIN
    high[beyond(low) <= best] = 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        is_too_far = beyond(middle) > best
        low, high = np.where(is_too_far, middle, low), np.where(is_too_far, high, middle)
    upper, lower = rolled(high)
    rotations[:, limb.top] = multiply(rotations[:, limb.top], upper)
    rotations[:, limb.middle] = multiply(multiply(conjugate(upper), now), lower)
    rotations[:, limb.end] = multiply(conjugate(lower), rotations[:, limb.end])


def _hinge(way: Floats, limits: tuple[Floats, Floats]) -> Floats | None:
    """Return the axis that a joint bends about, in its frame, (3,); None where it is no hinge.

    Args:
        way: Along the segment below it; turning about that is no bending.
        limits: Of the joint [degrees].
    """
    ranges = np.minimum(limits[1] - limits[0], 360.0)
    along = int(np.argmax(np.abs(way)))
    side, hinge = sorted({0, 1, 2} - {along}, key=lambda axis: float(ranges[axis]))
    return np.eye(3)[hinge] if ranges[side] < min(_FREE, ranges[hinge]) else None


def _to_hinge(
    rest: Floats, now: Floats, ways: list[Floats], hinge: Floats
) -> tuple[Floats, Floats]:
    """Return the rolls that leave nothing but the bend, upper and lower segment's, each (F,)."""
    turned = multiply(conjugate(rest), now)
    bend = to_vector(multiply(turned, about(ways[1], -_twist(turned, ways[1]))))
    aslant, along = np.cross(hinge, bend) @ ways[1], bend @ hinge
    # Bent one way or the other, it is about the same axis.
    upper = np.arctan2(np.where(along < 0.0, -aslant, aslant), np.abs(along))
    # A bend to the side is none of the hinge's: a roll either way would be as right.
    left = np.clip((0.5 * np.pi - np.abs(upper)) / _SIDEWAYS, 0.0, 1.0)
    upper = upper * left**2 * (3.0 - 2.0 * left)
    bent = multiply(conjugate(rest), multiply(about(ways[0], -upper), now))
    return upper, -_twist(bent, ways[1])


def _twist(rotations: Floats, axis: Floats) -> Floats:
    """(F, 4), (3,) to (F,): how far rotations turn about a unit axis, in −π..π [rad]."""
    angle = 2.0 * np.arctan2(rotations[:, :3] @ axis, rotations[:, 3])
    return np.asarray((angle + np.pi) % (2.0 * np.pi) - np.pi)
