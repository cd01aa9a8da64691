"""When a contact holds a foot is one rule, whoever asks: who stands, who carries, who is solved."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.constraints import ContactConstraint, Space
from usdmotion.curves import ease
from usdmotion.kernels import rotate
from usdmotion.travelling import (
    Meanings,
    Traveller,
    footprint_of,
    footprints_of,
    held_by,
    is_footprint,
)

TIMES = np.linspace(1.0, 3.0, 49)
BODY = Meanings(
    path="/Body",
    joints=("Foot", "Toes", "Hand"),
    parts=("l_talocrural", "l_metatarsophalangeal", "r_radiocarpal"),
    frames=np.tile((0.0, 0.0, 0.0, 1.0), (3, 1)),
    leg=0.9,
)
CONTACT = ContactConstraint(
    path="", skeleton="/Body", joint="Toes", location=np.array([1.0, 0.1, 2.0])
)
KEYS = {"none": (), "two": (1.5, 2.0), "four": (1.2, 1.5, 2.0, 2.4)}


def travelling(*contacts):
    return [Traveller(f"Contact{index}", each) for index, each in enumerate(contacts)]


@pytest.mark.parametrize("keys", KEYS.values(), ids=KEYS)
def test_a_contact_holds_where_its_easing_is_one(keys):
    contact = replace(CONTACT, times=keys)
    start, end = contact.held(TIMES)
    assert (start, end) == ((1.5, 2.0) if keys else (1.0, 3.0))
    on = ease(TIMES, keys) >= 1.0
    assert on.any()
    np.testing.assert_array_equal(on, (TIMES >= start - 1e-6) & (TIMES <= end + 1e-6))
    (found,) = footprints_of(travelling(contact), BODY, TIMES)
    assert (found.part, found.start, found.end) == ("l_metatarsophalangeal", start, end)
    np.testing.assert_array_equal(found.during(TIMES), on)
    assert held_by(travelling(contact), BODY, TIMES) == [("l_metatarsophalangeal", start, end)]


@pytest.mark.parametrize("kind", ["space", "line", "point", "plane", "slide"])
def test_only_what_is_held_in_place_stands_and_carries(kind):
    asked = travelling(replace(CONTACT, kind=kind))
    stands = kind in ("space", "line", "point")
    assert bool(footprints_of(asked, BODY, TIMES)) == stands
    assert bool(held_by(asked, BODY, TIMES)) == stands


@pytest.mark.parametrize("off", [0.0, np.zeros(len(TIMES))], ids=["a number", "a curve"])
def test_what_is_switched_off_neither_stands_nor_carries(off):
    asked = travelling(replace(CONTACT, activity=off))
    assert not footprints_of(asked, BODY, TIMES)
    assert not held_by(asked, BODY, TIMES)


def test_an_example_is_a_contact_like_any_other():
    (found,) = footprints_of(travelling(replace(CONTACT, template=True)), BODY, TIMES)
    np.testing.assert_array_equal(found.place, CONTACT.location)


def test_what_goes_along_with_a_joint_neither_stands_nor_carries():
    asked = travelling(replace(CONTACT, space=Space(joint=("/Body", "Hand"))))
    assert not footprints_of(asked, BODY, TIMES)
    assert not held_by(asked, BODY, TIMES)


def test_a_hand_carries_and_leaves_no_footprint():
    asked = travelling(replace(CONTACT, joint="Hand"))
    assert not footprints_of(asked, BODY, TIMES)
    assert held_by(asked, BODY, TIMES) == [("r_radiocarpal", 1.0, 3.0)]


def test_what_is_on_at_other_times_only_leaves_no_footprint():
    assert not footprints_of(travelling(replace(CONTACT, times=(3.5, 4.0))), BODY, TIMES)


def test_a_footprint_is_where_the_joint_is_when_its_point_is_held():
    turn, lift = (Rotation.random(random_state=seed).as_quat() for seed in (1, 2))
    space = Space(np.array([0.5, 0.0, 0.0]), lift)
    point = np.array([0.0, -0.02, 0.1])
    held = replace(CONTACT, point=point, orientation=turn, space=space)
    assert is_footprint(held, "l_metatarsophalangeal")
    found = footprint_of(held, "l_metatarsophalangeal", TIMES)
    np.testing.assert_allclose(
        found.place + rotate(found.rotation, point),
        space.translation + rotate(lift, held.location),
        atol=1e-12,
    )
    loose = footprint_of(replace(held, kind="point"), "l_metatarsophalangeal", TIMES, facing=turn)
    assert loose.rotation is None
    np.testing.assert_allclose(
        loose.place + rotate(turn, point), space.translation + rotate(lift, held.location)
    )
