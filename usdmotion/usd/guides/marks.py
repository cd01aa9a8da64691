"""Contacts of a stage as values: guides and pictures are drawn from the same."""

from collections.abc import Sequence

import numpy as np
from pxr import Usd

from usdmotion.guides import Color, ContactMark, apart, contact_guide
from usdmotion.usd.guides.colors import colors_of
from usdmotion.usd.guides.holds import key_times, read_held
from usdmotion.usd.guides.objects import Touched, touched_on
from usdmotion.usd.relations import floats, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts

_RIGHT = {"Y": np.sqrt((0.5, 0.0, 0.5)) * (1.0, 0.0, -1.0), "Z": np.sqrt((0.5, 0.5, 0.0))}
"""Numbers are read from the front, and from the side that is on the right of it."""


def read_contact_marks(stage: Usd.Stage) -> tuple[ContactMark, ...]:
    """Return every contact of a stage that is switched on, object by object.

    Detected, authored by hand or carried over from elsewhere, of joints or of props: what is
    returned is what they say now.

    Raises:
        SceneError: The motion of what one holds cannot be read.
    """
    return marks_of(stage, touched_on(stage))


def marks_of(stage: Usd.Stage, touched: Sequence[Touched]) -> tuple[ContactMark, ...]:
    """Return the contacts of some objects."""
    facts = read_facts(stage)
    colors = colors_of(stage, [each.contacts for each in touched])
    return tuple(
        mark
        for each, color in zip(touched, colors, strict=True)
        for mark in _marks(each, color, facts)
    )


def _marks(touched: Touched, color: Color, facts: Facts) -> list[ContactMark]:
    numbers = _numbers(touched.contacts)
    guides = [
        contact_guide(
            read_held(prim, touched.trajectory, facts, is_foot=touched.is_foot),
            touched.held.points,
            number,
            _RIGHT[facts.up_axis],
            facts.up,
        )
        for prim, number in zip(touched.contacts, numbers, strict=True)
    ]
    found = []
    for prim, number, shown in zip(touched.contacts, numbers, apart(guides, facts.up), strict=True):
        first, start, end, last = key_times(prim, touched.trajectory)
        found.append(
            ContactMark(
                path=str(prim.GetPath()),
                held=touched.held,
                color=color,
                number=number,
                kind=str(value(prim, "usdmotion:kind", "space")),
                guide=shown,
                first=first,
                start=start,
                end=end,
                last=last,
                always=not floats(value(prim, "usdmotion:times", ())),
            )
        )
    return found


def _numbers(contacts: Sequence[Usd.Prim]) -> list[int]:
    """Return the number in the name of each contact, and to those without one that is free."""
    ends = [prim.GetName()[len(prim.GetName().rstrip("0123456789")) :] for prim in contacts]
    taken = {int(end) for end in ends if end}
    free = (number for number in range(1, 2 * len(contacts) + 1) if number not in taken)
    numbers: list[int] = []
    for end in ends:
        own = int(end) if end else None
        numbers.append(next(free) if own is None or own in numbers else own)
    return numbers
