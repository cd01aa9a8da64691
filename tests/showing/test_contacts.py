"""Contacts over a pose: numbered, in the colour of their object, strong while they are on."""

import numpy as np
import pytest

from usdmotion.drawing.strips import Curve, Patch, Spot
from usdmotion.guides import COLORS, ContactGuide, ContactMark, ContactObject
from usdmotion.showing.contacts import contact_marks

SOLE = np.array(((0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.1, 0.0, 0.3)))
NOTHING = np.zeros((0, 3))


def contact(number, *, joint="", sole=SOLE, times=(10.0, 12.0, 20.0, 24.0), always=False):
    course = np.array(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)))
    held = ContactObject("/Foot", joint, SOLE, np.ones(3), 1.0, course)
    lifted = (np.array(((0.0, 1.0, 0.0), (0.0, 2.0, 0.0))),)
    guide = ContactGuide(
        marks=SOLE + np.array((number, 0.0, 0.0)),
        axis=course,
        way=course[:1],
        number=lifted,
        translation=np.zeros(3),
        rotation=np.array((0.0, 0.0, 0.0, 1.0)),
        sole=sole,
    )
    path = f"/Foot/Contacts/C{number}"
    return ContactMark(path, held, COLORS[1], number, "space", guide, *times, always)


def number_of(marked):
    (spot,) = [mark for mark in marked if isinstance(mark, Spot) and mark.sign == "number"]
    return spot


@pytest.mark.parametrize(
    ("code", "strength"),
    [(1.0, 0.3), (10.0, 0.3), (11.0, 0.65), (12.0, 1.0), (20.0, 1.0), (22.0, 0.65), (30.0, 0.3)],
)
def test_a_contact_is_as_strong_as_it_is_on(code, strength):
    spot = number_of(contact_marks([contact(3)], code))
    assert spot.opacity == pytest.approx(strength)
    assert (spot.text, spot.color) == ("3", COLORS[1])
    assert number_of(contact_marks([contact(3, always=True)], code)).opacity == 1.0


def test_a_contact_that_begins_at_once_is_on_or_off():
    sudden = contact(1, times=(10.0, 10.0, 20.0, 20.0))
    strengths = [number_of(contact_marks([sudden], code)).opacity for code in (9.9, 10.0, 20.1)]
    assert strengths == [0.3, 1.0, 0.3]


def test_a_foot_leaves_a_print_and_anything_else_its_points():
    print_, *others = [m for m in contact_marks([contact(1)], 15.0) if isinstance(m, Patch)]
    assert np.array_equal(print_.points, SOLE) and not others
    marked = contact_marks([contact(1, sole=NOTHING)], 15.0)
    held = [m.point for m in marked if isinstance(m, Spot) and m.sign == "held"]
    assert np.array_equal(held, SOLE + np.array((1.0, 0.0, 0.0)))
    assert not any(isinstance(mark, Patch) for mark in marked)


def test_of_many_contacts_only_those_are_numbered_that_are_on():
    times = (40.0, 42.0, 50.0, 54.0)
    feet = [contact(each, joint="Hips/Foot", times=times) for each in range(2, 30)]
    assert number_of(contact_marks([contact(1), *feet], 15.0)).text == "1"
    dice = [contact(each, times=times) for each in range(2, 30)]
    assert len([m for m in contact_marks(dice, 15.0) if isinstance(m, Spot)]) == len(dice)


def test_where_a_prop_goes_is_drawn_once_and_what_is_on_above_what_is_not():
    later = contact(2, times=(40.0, 42.0, 50.0, 54.0))
    marked = contact_marks([contact(1), later], 15.0)
    courses = [m for m in marked if isinstance(m, Curve) and m.width < 1.0]
    assert len(courses) == 1
    of_joint = contact_marks([contact(1, joint="Hips/Foot")], 15.0)
    assert not any(isinstance(mark, Curve) and mark.width < 1.0 for mark in of_joint)
    numbers = [m.text for m in marked if isinstance(m, Spot)]
    assert numbers == ["2", "1"]
