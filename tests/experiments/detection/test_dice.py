"""2006, section 8.1: every contact of two rolling dice is found where it is, and none invented."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion import NoisePattern, Search, demos, pipeline
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


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return what the command finds that the demo tells to run, and the stage that it writes."""
    folder = tmp_path_factory.mktemp("dice")
    shot, output = demos.build("dice", folder), folder / "dice.contacts.usda"
    words = demos.following("dice", shot).split()
    prims, kinds = (words[words.index(flag) + 1].split(",") for flag in ("--prims", "--kinds"))
    return pipeline.detect(shot, output, prims=prims, kinds=kinds), Usd.Stage.Open(str(output))


@pytest.mark.parametrize("name", ["first", "second"])
def test_the_command_finds_the_same_with_no_threshold_given(written, name):
    report, stage = written
    (die,) = (each for each in report.objects if each.path.endswith(name.title()))
    truths = getattr(dice, name)().contacts
    assert [each.kind for each in die.contacts] == [each.kind for each in truths]
    for contact, truth in zip(die.contacts, truths, strict=True):
        ends = dice.FIRST + RATE * np.array((truth.start, truth.end))
        assert np.abs((contact.start, contact.end) - ends).max() <= RATE * FRAME
        prim = stage.GetPrimAtPath(contact.path)
        place, axis = (
            prim.GetAttribute(f"usdmotion:{each}").Get() for each in ("location", "axis")
        )
        apart = np.array(place) * 0.01 - truth.location
        apart = np.cross(apart, truth.axis) if truth.kind == "line" else apart
        assert np.linalg.norm(apart) <= 0.01 * EDGE
        if truth.kind == "line":
            assert angle(np.array(axis), truth.axis) <= 1.0
