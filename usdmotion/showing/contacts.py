"""What is drawn of contacts: footprints, axes and points, each with its number."""

from collections.abc import Iterator, Sequence

import numpy as np

from usdmotion.drawing.strips import Curve, Mark, Patch, Spot
from usdmotion.guides import ContactMark

_PALE = 0.3
"""How strong a contact is that is not on."""
_FEW = 6
"""Of more contacts of joints, which are near each other, only those are numbered that are on."""
_AREA = 0.5
"""How strong the area of a footprint is, over the contact's."""


def contact_marks(contacts: Sequence[ContactMark], time_code: float) -> tuple[Mark, ...]:
    """Return what is to be drawn of contacts at a time: strong those that are on, pale the others.

    Where a prop goes is drawn as well; joints have their trajectories where something is asked.

    Args:
        contacts: Those of a stage.
        time_code: When.
    """
    props = {each.object: each for each in contacts if not each.held.joint}
    ways = [Curve(each.held.course, each.color, 0.7, _PALE) for each in props.values()]
    numbered = 0.0 if sum(bool(each.held.joint) for each in contacts) <= _FEW else _PALE
    # What is on is drawn over what is not.
    ordered = sorted(contacts, key=lambda each: _strength(each, time_code))
    return (*ways, *(mark for each in ordered for mark in _contact(each, time_code, numbered)))


def _contact(contact: ContactMark, time_code: float, numbered: float) -> Iterator[Mark]:
    """Yield one contact, with its number where it is stronger than that."""
    guide, color, strong = contact.guide, contact.color, _strength(contact, time_code)
    far = strong <= _PALE
    if len(guide.sole):
        yield Patch(guide.sole, color, _AREA * strong)
    else:
        for point in guide.marks[:1] if far else guide.marks:
            yield Spot(point, "held", color, strong, beyond=far)
    if len(guide.axis):
        yield Curve(guide.axis, color, 1.6, strong)
    if strong > numbered:
        # Guides lift the numbers of one object off each other; at a foot there is no room for it.
        lifted = np.concatenate(guide.number)
        place = (guide.marks if contact.held.joint else lifted).mean(axis=0)
        yield Spot(place, "number", color, strong, str(contact.number), beyond=True)


def _strength(contact: ContactMark, time_code: float) -> float:
    """Return how strong a contact is drawn: wholly while it is on, in between as it eases."""
    if contact.always or contact.start <= time_code <= contact.end:
        return 1.0
    into = time_code < contact.start
    ease = contact.start - contact.first if into else contact.last - contact.end
    away = contact.start - time_code if into else time_code - contact.end
    on = max(1.0 - away / ease, 0.0) if ease > 0.0 else 0.0
    return _PALE + (1.0 - _PALE) * on
