"""2006, section 8.1: every contact of two rolling dice is found where it is, and none invented."""

import numpy as np
import pytest

from usdmotion import NoisePattern, Search
from usdmotion.curves import Spline
from usdmotion.demos import dice
from usdmotion.demos.rolling import EDGE, RATE
from usdmotion.plugins import host

KINDS = ("space", "line", "point")
SIGMA, EPSILON = 1e-4, 1e-5
"""Minimal thresholds, as the paper has them for a motion without noise; the second in metres."""
FRAME = 1.001 / RATE
"""A frame that one contact ends with and the next begins with belongs to one of them."""


@pytest.fixture(scope="module", params=["first", "second"])
def rolled(request):
    return getattr(dice, request.param)()


def constant(value):
    return Spline(np.zeros(1), np.array([value]), np.zeros(1))


def found(rolled, **asked):
    search = Search(
        name="die",
        times=rolled.times,
        translations=rolled.translations,
        rotations=rolled.rotations,
        pattern=NoisePattern(constant(SIGMA), constant(EPSILON)),
        **asked,
    )
    return host().detector("contacts")().detect(search).contacts


def angle(one, other):
    """Return the angle between two lines [degrees]."""
    return np.degrees(np.arccos(np.clip(abs(one @ other), 0.0, 1.0)))


def away(contact, truth):
    """Return how far a place is from where it is, along a line not counted [m]."""
    apart = contact.location - truth.location
    return np.linalg.norm(np.cross(apart, truth.axis) if truth.kind == "line" else apart)


def test_every_contact_is_found_when_it_is_and_none_besides(rolled):
    contacts = found(rolled, kinds=KINDS)
    assert [each.kind for each in contacts] == [each.kind for each in rolled.contacts]
    for contact, truth in zip(contacts, rolled.contacts, strict=True):
        assert abs(contact.start - truth.start) <= FRAME
        assert abs(contact.end - truth.end) <= FRAME


def test_it_is_found_where_it_is(rolled):
    for contact, truth in zip(found(rolled, kinds=KINDS), rolled.contacts, strict=True):
        assert away(contact, truth) <= 0.01 * EDGE
        if truth.kind == "line":
            assert angle(contact.axis, truth.axis) <= 1.0


@pytest.mark.parametrize("kind", KINDS)
def test_one_kind_alone_is_found_without_the_others(rolled, kind):
    contacts = found(rolled, kinds=(kind,))
    assert [each.kind for each in contacts].count(kind) == len(contacts)
    whole = [each for each in rolled.contacts if each.kind == kind]
    for truth in whole:
        assert any(
            each.start - FRAME <= truth.start and truth.end <= each.end + FRAME for each in contacts
        )
