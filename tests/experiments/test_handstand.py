"""2005, section 11: hands carry the root in a handstand, whatever the arms are like."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion import demos, pipeline
from usdmotion.demos.acrobatics import FEET_DOWN, FEET_UP, HANDS_DOWN, HANDS_UP, handstand
from usdmotion.demos.handstand import ROOT, SKELETON, others
from usdmotion.demos.walker import FIRST, RATE

NAMES = tuple(member.name for member in others())
BOTH = pytest.mark.parametrize("name", NAMES)


@pytest.fixture(scope="module")
def times():
    return handstand().motion.times


@pytest.fixture(scope="module")
def takes(tmp_path_factory, taken, times):
    folder = tmp_path_factory.mktemp("handstand")
    shot, codes = demos.build("handstand", folder), FIRST + times * RATE
    found = {"Acrobat": taken(Usd.Stage.Open(str(shot)), SKELETON, codes)}
    for name in NAMES:
        skeleton, output = f"/{ROOT}/{name}/Skeleton", folder / f"{name}.usda"
        pipeline.retarget(shot, shot, output, motion=SKELETON, skeleton=skeleton)
        found[name] = taken(Usd.Stage.Open(str(output)), skeleton, codes)
    return found


def height(take, name):
    return take.point(name)[:, 1]


@BOTH
def test_hands_stay_where_they_are_on_the_ground(takes, times, name):
    down = (times >= HANDS_DOWN) & (times <= HANDS_UP)
    for hand in ("LeftHand", "RightHand"):
        places = takes[name].point(hand)[down]
        assert np.linalg.norm(places - places.mean(axis=0), axis=1).max() <= 0.002
        assert (
            np.abs(height(takes[name], hand) - height(takes["Acrobat"], hand))[down].max() <= 0.005
        )


@BOTH
def test_feet_stand_and_do_not_sink(takes, times, name):
    down = (times <= FEET_UP) | (times >= FEET_DOWN)
    for foot in ("LeftFoot", "RightFoot"):
        usual = height(takes["Acrobat"], foot)
        assert np.abs(height(takes[name], foot) - usual)[down].max() <= 0.005
    every = takes[name].world[:, :, 3, 1]
    assert every.min() >= takes["Acrobat"].world[:, :, 3, 1].min() - 0.005


@BOTH
def test_the_root_is_as_high_as_the_arms_that_carry_it_are_long(takes, times, name):
    upside_down = (times >= 2.3) & (times <= 3.1)
    higher = (height(takes[name], "Hips") - height(takes["Acrobat"], "Hips"))[upside_down]
    arms = [
        np.linalg.norm(take.point("LeftForeArm") - take.point("LeftArm"), axis=1)[0]
        + np.linalg.norm(take.point("LeftHand") - take.point("LeftForeArm"), axis=1)[0]
        for take in (takes[name], takes["Acrobat"])
    ]
    assert np.abs(higher - (arms[0] - arms[1])).max() <= 0.03
    assert abs(arms[0] - arms[1]) > 0.1


@BOTH
def test_nothing_jolts(takes, name):
    usual = max(takes["Acrobat"].jolt(joint) for joint in takes["Acrobat"].joints)
    assert max(takes[name].jolt(joint) for joint in takes[name].joints) <= usual + 5.0
