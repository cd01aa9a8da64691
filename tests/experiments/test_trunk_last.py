"""2005, section 9: no trunk moves for what an arm can do, and it moves for what an arm cannot."""

import numpy as np
import pytest

from usdmotion.demos.grasp import FRAMES
from usdmotion.demos.trunk_last import PLACES

ARM = ("RightArm", "RightForeArm")
BOTH = pytest.mark.parametrize("asked", PLACES)


@pytest.fixture
def solved(shown, asked):
    return shown("trunk_last", asked=asked)


def moved(solved):
    """Return which joints are turned, or moved, on any frame, to the last bit."""
    return {
        joint.rsplit("/", 1)[-1]
        for index, joint in enumerate(solved.before.joints)
        if not np.array_equal(solved.after.local[:, index], solved.before.local[:, index])
    }


@BOTH
def test_the_wrist_is_at_its_place(solved, asked):
    missed = solved.after.point("RightHand") - PLACES[asked]
    assert solved.millimetres(missed[solved.on(FRAMES)]) <= 1.0


def test_what_the_arm_can_reach_it_reaches_alone(shown):
    solved = shown("trunk_last", asked="within")
    assert moved(solved) == set(ARM)
    assert np.array_equal(solved.after.point("Hips"), solved.before.point("Hips"))


def test_what_it_cannot_the_trunk_does(shown):
    solved = shown("trunk_last", asked="beyond")
    assert moved(solved) & {"RightShoulder", "Spine", "Spine1", "Spine2"}


@BOTH
def test_it_comes_and_goes_without_a_jolt(solved, asked):
    assert solved.jolted() <= 5.0
    assert solved.pops("RightForeArm") <= 8.0
    assert solved.apart(solved.away(FRAMES)) <= 0.1
