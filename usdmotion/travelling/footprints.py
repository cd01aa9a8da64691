"""Contacts of feet, as the footprints that a body is to stand on."""

from collections.abc import Iterator, Sequence
from typing import TypeGuard

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.constraints import Constraint, ContactConstraint
from usdmotion.humanoid import FEET
from usdmotion.kernels import multiply, rotate
from usdmotion.s4d import Footprint, Held
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.meanings import Meanings


def is_footprint(constraint: Constraint, part: str) -> TypeGuard[ContactConstraint]:
    """Tell whether a constraint is a contact that holds a foot in place in the world.

    Args:
        constraint: Of any kind.
        part: H-Anim name of its joint, "" for none.
    """
    return (
        part in FEET
        and isinstance(constraint, ContactConstraint)
        and constraint.stays
        and constraint.space.joint is None
        and constraint.space.translation.ndim == 1
        and constraint.space.rotation.ndim == 1
    )


def frames_of(contact: ContactConstraint, times: Floats) -> Bools:
    """Return on which frames the footprint of a contact is there, shape (frame_count,)."""
    return Footprint("", *contact.held(times), np.zeros(3)).during(times)


def footprint_of(
    contact: ContactConstraint, part: str, times: Floats, facing: Floats | None = None
) -> Footprint:
    """Return the footprint that a contact of a foot is.

    Args:
        contact: One that is a footprint; of a point that goes about in its joint, the mean counts.
        part: H-Anim name of its joint.
        times: Seconds of the frames.
        facing: World orientation of the joint meanwhile, xyzw, where the contact lets it turn; None
            takes what the contact says that it was.
    """
    space = contact.space
    said = multiply(space.rotation, contact.orientation)
    turned = contact.kind == "space"
    location = space.translation + rotate(space.rotation, contact.location)
    point = np.reshape(contact.point, (-1, 3)).mean(axis=0)
    return Footprint(
        part,
        *contact.held(times),
        location - rotate(said if turned or facing is None else facing, point),
        said if turned else None,
    )


def contacts_of_feet(
    travellers: Sequence[Traveller], body: Meanings
) -> Iterator[tuple[str, str, ContactConstraint]]:
    """Yield name, part and constraint of the contacts of ankles and balls that are on a body."""
    for each in travellers:
        part = _part(each.constraint, body)
        if isinstance(each.constraint, ContactConstraint) and part in FEET:
            yield each.name, part, each.constraint


def held_by(travellers: Sequence[Traveller], body: Meanings, times: Floats) -> list[Held]:
    """Return the parts of a body that contacts keep in place, in the world or a prop, and when.

    Args:
        travellers: Constraints on the body.
        body: The body.
        times: Seconds of the frames.
    """
    held = []
    for each in travellers:
        contact, part = each.constraint, _part(each.constraint, body)
        if part and isinstance(contact, ContactConstraint) and contact.stays:
            if contact.space.joint is None:
                held.append((part, *contact.held(times)))
    return held


def footprints_of(
    travellers: Sequence[Traveller], body: Meanings, times: Floats
) -> tuple[Footprint, ...]:
    """Return where ankles and balls are held in the world, and when.

    A contact of another point than the joint's own says where the joint is only if it says how that
    is turned.

    Args:
        travellers: Constraints in metres, on the body.
        body: The body.
        times: Seconds of the frames; what is on at other times only leaves no footprint.
    """
    props = {each.name for each in travellers if each.props.get("")}
    return tuple(
        footprint_of(contact, part, times)
        for name, part, contact in contacts_of_feet(travellers, body)
        if name not in props
        and is_footprint(contact, part)
        and frames_of(contact, times).any()
        and (contact.kind == "space" or not contact.point.any())
    )


def _part(constraint: Constraint, body: Meanings) -> str:
    joint = body.named(constraint.joint) if constraint.joint else None
    return "" if joint is None else body.parts[joint]
