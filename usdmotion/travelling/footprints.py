"""Contacts of feet that have come to a body, as the footprints that it is to stand on."""

from collections.abc import Iterator, Sequence

from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint
from usdmotion.kernels import rotate
from usdmotion.s4d import Footprint, Held
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.meanings import Meanings

_FEET = tuple(f"{side}_{part}" for side in "lr" for part in ("talocrural", "metatarsophalangeal"))
_SLACK = 1e-6
"""Times closer than this are the same [s]."""


def contacts_of_feet(
    travellers: Sequence[Traveller], body: Meanings
) -> Iterator[tuple[str, str, ContactConstraint]]:
    """Yield name, part and constraint of the contacts of ankles and balls that are on a body."""
    for each in travellers:
        constraint = each.constraint
        joint = body.named(constraint.joint) if constraint.joint else None
        part = "" if joint is None else body.parts[joint]
        if isinstance(constraint, ContactConstraint) and part in _FEET:
            yield each.name, part, constraint


def held_by(travellers: Sequence[Traveller], body: Meanings) -> list[Held]:
    """Return the parts of a body that contacts hold, and when."""
    held = []
    for each in travellers:
        contact = each.constraint
        joint = body.named(contact.joint) if contact.joint else None
        part = "" if joint is None else body.parts[joint]
        if isinstance(contact, ContactConstraint) and part and contact.times:
            held.append((part, *_ends(contact)))
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
        times: Seconds of the frames; what is fully on at other times only leaves no footprint.
    """
    props = {each.name for each in travellers if each.props.get("")}
    return tuple(
        _footprint(part, contact)
        for name, part, contact in contacts_of_feet(travellers, body)
        if name not in props and _says_where(contact) and _is_on(contact, times)
    )


def _says_where(contact: ContactConstraint) -> bool:
    held = contact.kind == "space" or (
        contact.kind in ("line", "point") and not contact.point.any()
    )
    still = contact.point.ndim == 1 and contact.space.joint is None
    return held and still and bool(contact.times) and contact.activity is not None


def _is_on(contact: ContactConstraint, times: Floats) -> bool:
    start, end = _ends(contact)
    return bool(start <= times[-1] + _SLACK and end >= times[0] - _SLACK)


def _footprint(part: str, contact: ContactConstraint) -> Footprint:
    start, end = _ends(contact)
    turned = contact.kind == "space"
    return Footprint(
        part=part,
        start=start,
        end=end,
        place=contact.location - rotate(contact.orientation, contact.point),
        rotation=contact.orientation if turned else None,
    )


def _ends(contact: ContactConstraint) -> tuple[float, float]:
    """Return when a contact that has times is fully on, first and last [s]."""
    times = contact.times[1:3] if len(contact.times) > 2 else contact.times
    return times[0], times[-1]
