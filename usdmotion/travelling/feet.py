"""Knee, ankle and ball that are held agree, whatever the length of shank and foot."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import conjugate, forward, rotate
from usdmotion.s4d import Morphology
from usdmotion.travelling.balls import ball_in_ankle, holds_ball
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.footprints import contacts_of_feet
from usdmotion.travelling.meanings import Meanings

_BESIDE = 0.3
"""How far a foot is behind or beside a knee at least, over the shank, to be led away from it."""


def with_own_feet(
    travellers: Sequence[Traveller], meanings: Meanings, body: Morphology, times: Floats
) -> tuple[Traveller, ...]:
    """Return constraints whose ankles are as far from balls and knees as a body is built.

    A step is from ball to ball, so it is the ankle that gives way: it stands where its orientation
    and the ball of the contact that is on meanwhile say. Who kneels does it on his knee, so it is
    the foot of that leg that is moved along the ground, as far as the shank is long.

    Args:
        travellers: Constraints in metres, on the body.
        meanings: What parts mean on it.
        body: The body.
        times: Seconds of the frames.
    """
    travellers = _behind_knees(travellers, meanings, body, times)
    feet = list(contacts_of_feet(travellers, meanings))
    moved: dict[str, ContactConstraint] = {}
    for name, part, ankle in feet:
        side, _, joint = part.partition("_")
        if joint != ANKLE or not _is_whole(ankle):
            continue
        balls = [
            ball
            for _, other, ball in feet
            if other[0] == side
            and _is_of_ball(ball, other, body)
            and _together(ankle, ball, times) > 0.0
        ]
        if balls:
            ball = max(balls, key=lambda each: _together(ankle, each, times))
            moved[name] = _by_ball(ankle, ball, _way(body, side))
    return tuple(
        replace(each, constraint=moved[each.name]) if each.name in moved else each
        for each in travellers
    )


def _behind_knees(
    travellers: Sequence[Traveller], meanings: Meanings, body: Morphology, times: Floats
) -> tuple[Traveller, ...]:
    """Return constraints whose ankles are a shank away from knees that are held meanwhile.

    The ball of such a foot goes along.
    """
    knees = [
        (part, knee)
        for part, knee in _contacts(travellers, meanings)
        if part.endswith("_knee") and not knee.point.any() and _is_placed(knee)
    ]
    up = rotate(conjugate(meanings.turn), np.array([0.0, 1.0, 0.0]))
    feet = [each for each in contacts_of_feet(travellers, meanings) if _is_placed(each[2])]
    moved: dict[str, ContactConstraint] = {}
    for name, part, ankle in feet:
        side, _, joint = part.partition("_")
        leg = [knee for other, knee in knees if other == f"{side}_knee"]
        knee = max(leg, key=lambda each: _together(each, ankle, times), default=None)
        if joint != ANKLE or _is_of_ball(ankle, part, body) or knee is None:
            continue
        if _together(knee, ankle, times) <= 0.0:
            continue
        shank = next(limb.lower for limb in body.limbs if limb.name == f"{side}_hip")
        step = _along(_place(ankle) - knee.location, shank, up)
        for other, its, foot in feet:
            is_ball = its == f"{side}_{BALL}" or (its[0] == side and _is_of_ball(foot, its, body))
            goes_along = is_ball and _together(ankle, foot, times) > 0.0
            if other == name or (goes_along and other not in moved):
                moved[other] = replace(foot, location=foot.location + step)
    return tuple(
        replace(each, constraint=moved[each.name]) if each.name in moved else each
        for each in travellers
    )


def _along(way: Floats, length: float, up: Floats) -> Floats:
    """Return what makes a way as long as something, along the ground, where it leads along that."""
    rise = float(way @ up)
    level = way - rise * up
    size = float(np.linalg.norm(level))
    if size <= _BESIDE * length:
        return np.zeros(3)
    return np.asarray((np.sqrt(max(length**2 - rise**2, 0.0)) / size - 1.0) * level)


def _is_placed(contact: ContactConstraint) -> bool:
    return contact.space.joint is None and contact.location.ndim == 1 and contact.point.ndim == 1


def _place(contact: ContactConstraint) -> Floats:
    """Return where the joint of a contact is that says how that is turned [m], shape (3,)."""
    return contact.location - rotate(contact.orientation, contact.point)


def _contacts(
    travellers: Sequence[Traveller], meanings: Meanings
) -> Iterator[tuple[str, ContactConstraint]]:
    """Yield part and constraint of all contacts of parts."""
    for each in travellers:
        contact = each.constraint
        joint = meanings.named(contact.joint) if contact.joint else None
        if isinstance(contact, ContactConstraint) and joint is not None:
            yield meanings.parts[joint], contact


def _is_whole(contact: ContactConstraint) -> bool:
    """Tell whether a contact says where its joint is, and how it is turned."""
    at_rest = contact.point.ndim == 1 and contact.space.joint is None
    return contact.kind == "space" and contact.stays and at_rest


def _is_of_ball(contact: ContactConstraint, part: str, body: Morphology) -> bool:
    """Tell whether a contact says where the ball of a foot is."""
    if part.endswith(BALL):
        return _is_whole(contact)
    return holds_ball(contact, part, body) and contact.stays and contact.space.joint is None


def _together(one: ContactConstraint, other: ContactConstraint, times: Floats) -> float:
    """Return for how long two contacts hold at once [s]."""
    (start, end), (first, last) = one.held(times), other.held(times)
    return min(end, last) - max(start, first)


def _by_ball(ankle: ContactConstraint, ball: ContactConstraint, way: Floats) -> ContactConstraint:
    """Return the contact of an ankle that is a foot away from its ball."""
    whole = ball.kind == "space"
    held = ball.location - rotate(ball.orientation, ball.point) if whole else ball.location
    place = held - rotate(ankle.orientation, way)
    return replace(ankle, location=place + rotate(ankle.orientation, ankle.point))


def _way(body: Morphology, side: str) -> Floats:
    """Return where the ball of a foot is at rest, in the frame of its ankle [m], shape (3,)."""
    if body.parts.joint(f"{side}_{BALL}") is None:
        return ball_in_ankle(body, side)
    skeleton = body.skeleton
    _, orientations = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    ankle, ball = (body.joint(f"{side}_{part}") for part in (ANKLE, BALL))
    way = body.rest_positions[ball] - body.rest_positions[ankle]
    return np.asarray(rotate(conjugate(orientations[0, ankle]), way))
