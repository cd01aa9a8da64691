"""Contacts of feet that have come to a body, as the footprints that it is to stand on."""

from collections.abc import Iterator, Sequence

from usdmotion.constraints import ContactConstraint
from usdmotion.kernels import rotate
from usdmotion.s4d import Footprint
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.meanings import Meanings

_FEET = tuple(f"{side}_{part}" for side in "lr" for part in ("talocrural", "metatarsophalangeal"))


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


def footprints_of(travellers: Sequence[Traveller], body: Meanings) -> tuple[Footprint, ...]:
    """Return where ankles and balls are held in the world, and when.

    A contact of another point than the joint's own says where the joint is only if it says how that
    is turned.

    Args:
        travellers: Constraints in metres, on the body.
        body: The body.
    """
    props = {each.name for each in travellers if each.props.get("")}
    return tuple(
        _footprint(part, contact)
        for name, part, contact in contacts_of_feet(travellers, body)
        if name not in props and _says_where(contact)
    )


def _says_where(contact: ContactConstraint) -> bool:
    held = contact.kind == "space" or (
        contact.kind in ("line", "point") and not contact.point.any()
    )
    still = contact.point.ndim == 1 and contact.space.joint is None
    return held and still and bool(contact.times) and contact.activity is not None


def _footprint(part: str, contact: ContactConstraint) -> Footprint:
    ends = contact.times[1:3] if len(contact.times) > 2 else contact.times
    turned = contact.kind == "space"
    return Footprint(
        part=part,
        start=ends[0],
        end=ends[-1],
        place=contact.location - rotate(contact.orientation, contact.point),
        rotation=contact.orientation if turned else None,
    )
