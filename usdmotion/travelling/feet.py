"""Ankle and ball of a foot that stands agree, whatever the length of the foot."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import conjugate, forward, rotate
from usdmotion.s4d import Morphology
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.footprints import contacts_of_feet
from usdmotion.travelling.meanings import Meanings


def with_own_feet(
    travellers: Sequence[Traveller], meanings: Meanings, body: Morphology, times: Floats
) -> tuple[Traveller, ...]:
    """Return constraints whose ankles are as far from their balls as the feet of a body are long.

    A step is from ball to ball, so it is the ankle that gives way: it stands where its orientation
    and the ball of the contact that is on meanwhile say.

    Args:
        travellers: Constraints in metres, on the body.
        meanings: What parts mean on it.
        body: The body.
        times: Seconds of the frames.
    """
    feet = list(contacts_of_feet(travellers, meanings))
    moved: dict[str, ContactConstraint] = {}
    for name, part, ankle in feet:
        side, _, joint = part.partition("_")
        if joint != ANKLE or not _is_whole(ankle):
            continue
        balls = [
            ball
            for _, other, ball in feet
            if other == f"{side}_{BALL}" and _is_whole(ball) and _together(ankle, ball, times) > 0.0
        ]
        if balls:
            ball = max(balls, key=lambda each: _together(ankle, each, times))
            moved[name] = _by_ball(ankle, ball, _way(body, side))
    return tuple(
        replace(each, constraint=moved[each.name]) if each.name in moved else each
        for each in travellers
    )


def _is_whole(contact: ContactConstraint) -> bool:
    """Tell whether a contact says where its joint is, and how it is turned."""
    at_rest = contact.point.ndim == 1 and contact.space.joint is None
    return contact.kind == "space" and contact.stays and at_rest


def _together(one: ContactConstraint, other: ContactConstraint, times: Floats) -> float:
    """Return for how long two contacts hold at once [s]."""
    (start, end), (first, last) = one.held(times), other.held(times)
    return min(end, last) - max(start, first)


def _by_ball(ankle: ContactConstraint, ball: ContactConstraint, way: Floats) -> ContactConstraint:
    """Return the contact of an ankle that is a foot away from its ball."""
    held = ball.location - rotate(ball.orientation, ball.point)
    place = held - rotate(ankle.orientation, way)
    return replace(ankle, location=place + rotate(ankle.orientation, ankle.point))


def _way(body: Morphology, side: str) -> Floats:
    """Return where the ball of a foot is at rest, in the frame of its ankle [m], shape (3,)."""
    skeleton = body.skeleton
    _, orientations = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    ankle, ball = (body.joint(f"{side}_{part}") for part in (ANKLE, BALL))
    way = body.rest_positions[ball] - body.rest_positions[ankle]
    return np.asarray(rotate(conjugate(orientations[0, ankle]), way))
