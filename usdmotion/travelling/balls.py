"""Balls of feet that are no joints: what holds one holds a point of the ankle."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import rotate
from usdmotion.s4d import Morphology
from usdmotion.s4d.standing.legs import FRONT, UP, Leg
from usdmotion.travelling.carrying import Traveller

_BALLS = {f"{side}_{BALL}": side for side in "lr"}
_AS_POINT = ("space", "line", "point")


def with_points_for_balls(
    travellers: Sequence[Traveller], body: Morphology
) -> tuple[Traveller, ...]:
    """Return constraints of which the contacts of balls are on the ankles of a body without balls.

    What held the ball keeps holding it, as a point of the ankle's frame about which the foot may
    turn: toes that cannot be bent keep no orientation of theirs.

    Args:
        travellers: Constraints without a body.
        body: The body that they go to.
    """
    return tuple(_on_ankle(each, body) for each in travellers)


def ball_in_ankle(body: Morphology, side: str) -> Floats:
    """Return where the ball of a foot that is no joint is, in the frame of its ankle [m], (3,)."""
    leg = Leg.of(body, side)
    return np.asarray(rotate(leg.foot, _below(body) + leg.length * FRONT))


def holds_ball(contact: ContactConstraint, part: str, body: Morphology) -> bool:
    """Tell whether a contact on a body holds the ball of a foot where that is no joint."""
    side, _, joint = part.partition("_")
    is_point = contact.kind == "point" and contact.point.ndim == 1 and bool(contact.point.any())
    return joint == ANKLE and is_point and body.parts.joint(f"{side}_{BALL}") is None


def _on_ankle(traveller: Traveller, body: Morphology) -> Traveller:
    contact = traveller.constraint
    side = _BALLS.get(contact.joint, "")
    if not side or not isinstance(contact, ContactConstraint):
        return traveller
    if body.parts.joint(contact.joint) is not None or contact.point.ndim > 1:
        return traveller
    leg = Leg.of(body, side)
    way = (_below(body) + leg.length * FRONT) / body.leg_length
    location = contact.location
    if contact.space.joint is None and not traveller.props.get(""):
        # Places count from where the joint stands: from the ankle's height, it is that much lower.
        location = location + _below(body) / body.leg_length
    if contact.kind == "space":
        location = location - rotate(contact.orientation, contact.point)
    held = replace(
        contact,
        joint=f"{side}_{ANKLE}",
        kind="point" if contact.kind in _AS_POINT else contact.kind,
        point=way if contact.kind == "space" else way + contact.point,
        location=location,
    )
    return replace(traveller, constraint=held)


def _below(body: Morphology) -> Floats:
    """Return the way from the height of an ankle to that of the ball while soles are down [m]."""
    ankle, ball = body.standing_heights
    return (ball - ankle) * UP
