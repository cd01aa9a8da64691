"""2004, section 4: the centre of mass goes ahead, the feet stay on their trajectories."""

import numpy as np
import pytest

from usdmotion.curves import ease
from usdmotion.demos import against_the_wind, gait
from usdmotion.demos.walker import SKELETON, seconds


@pytest.fixture
def solved(demo, solve):
    return solve(demo("against_the_wind"), SKELETON)


def test_the_centre_of_mass_is_where_it_was_asked_to_be(solved):
    walk = gait.walk()
    keys = tuple(map(seconds, against_the_wind.FRAMES))
    asked = ease(walk.motion.times, keys)[:, None] * against_the_wind.LEAN
    assert np.abs(asked[:, 2]).max() == 0.1
    moved = solved.after.center_of_mass(walk.body) - solved.before.center_of_mass(walk.body)
    assert solved.millimetres(moved - asked) <= 0.05


def test_the_feet_stay_where_they_were(solved):
    walk = gait.walk()
    for side in ("Left", "Right"):
        assert solved.moved(f"{side}Foot", walk.heel_point) <= 0.01
        assert solved.moved(f"{side}ToeBase", walk.toe_point) <= 0.01


def test_no_knee_pops(solved):
    assert max(solved.pops("LeftLeg"), solved.pops("RightLeg")) <= 2.0


def test_before_and_after_the_wind_it_is_the_walk(solved):
    first, _, _, last = against_the_wind.FRAMES
    calm = (solved.after.times <= first) | (solved.after.times >= last)
    apart = solved.after.world[calm, :, 3, :3] - solved.before.world[calm, :, 3, :3]
    assert solved.millimetres(apart) <= 0.01


def test_the_trunk_does_not_nod_at_every_step(solved):
    for joint in ("Hips", "Spine", "Spine1", "Spine2"):
        assert solved.pops(joint) <= 3.5
