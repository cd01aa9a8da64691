"""Legs that kneel and stand are as long as those of the body, whatever they were."""

import numpy as np
import pytest

from usdmotion.constraints import ContactConstraint
from usdmotion.demos.body import Proportions, humanoid
from usdmotion.humanoid import PartMap
from usdmotion.s4d import Morphology
from usdmotion.travelling import Meanings, Traveller, with_own_feet

TIMES = np.linspace(0.0, 3.0, 91)
KNEE = np.array([0.1, 0.05, 0.4])
BEHIND = np.array([0.02, 0.08, -0.3])
UP = np.array([0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def body():
    skeleton, _, parts = humanoid(1.7, proportions=Proportions(legs=1.2))
    return Morphology.of(skeleton, PartMap(parts))


def held(body, part, place, times):
    joint = body.skeleton.joints[body.joint(part)]
    kind = "point" if part.endswith("knee") else "space"
    contact = ContactConstraint(
        path="", skeleton="/Body", joint=joint, location=place, kind=kind, times=times
    )
    return Traveller(part, contact)


def put(body, *travellers):
    meanings = Meanings.of("/Body", body, UP)
    there = with_own_feet(travellers, meanings, body, TIMES)
    return [each.constraint.location for each in there]


def test_the_foot_of_who_kneels_is_a_shank_behind_his_knee(body):
    foot = KNEE + BEHIND
    knee, moved = put(
        body, held(body, "l_knee", KNEE, (1.0, 2.0)), held(body, "l_talocrural", foot, (1.5, 3.0))
    )
    np.testing.assert_array_equal(knee, KNEE)
    assert np.linalg.norm(moved - KNEE) == pytest.approx(body.limbs[1].lower)
    assert moved[1] == foot[1]
    before, after = (place - KNEE for place in (foot, moved))
    assert np.cross(before, after)[1] == pytest.approx(0.0)
    assert before @ after > 0.0


@pytest.mark.parametrize(
    ("part", "times"), [("r_talocrural", (1.0, 2.0)), ("l_talocrural", (2.2, 3.0))]
)
def test_other_feet_and_other_times_stay(body, part, times):
    foot = KNEE + BEHIND
    _, stays = put(body, held(body, "l_knee", KNEE, (1.0, 2.0)), held(body, part, foot, times))
    np.testing.assert_array_equal(stays, foot)
