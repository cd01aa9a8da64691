"""2004, figure 4: with ranks the ankle rises and the footplants give way; without, nobody wins."""

import numpy as np
import pytest

from usdmotion.demos import gait, stepping
from usdmotion.demos.walker import SKELETON


@pytest.fixture
def ranked(demo, solve):
    return solve(demo("stepping"), SKELETON)


@pytest.fixture
def weighted(demo, solve):
    return solve(demo("stepping_weighted"), SKELETON)


def short(solved):
    """Return how far the ankle is from where it has to be on the plateau, each frame [m]."""
    _, start, end, _ = stepping.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    assert there.sum() == end - start + 1
    asked = solved.before.point("LeftFoot") + stepping.HIGHER
    return (solved.after.point("LeftFoot") - asked)[there]


def test_with_priorities_the_ankle_rises(ranked):
    assert ranked.millimetres(short(ranked)) <= 0.01


def test_with_one_priority_it_ends_between(weighted):
    share = np.linalg.norm(short(weighted), axis=1) / np.linalg.norm(stepping.HIGHER)
    assert share.min() >= 0.2
    assert share.max() <= 0.9


def test_the_other_foot_keeps_its_trajectory(ranked):
    walk = gait.walk()
    assert ranked.moved("RightFoot", walk.heel_point) <= 0.1
    assert ranked.moved("RightToeBase", walk.toe_point) <= 0.1


def test_what_gives_way_is_the_footplant(ranked):
    lifted = ranked.moved("LeftFoot", gait.walk().heel_point)
    assert lifted >= 100.0


def test_no_knee_pops(ranked, weighted):
    for solved in (ranked, weighted):
        assert max(solved.pops("LeftLeg"), solved.pops("RightLeg")) <= 2.0


def test_the_rest_of_the_walk_is_the_walk(ranked):
    first, _, _, last = stepping.FRAMES
    away = (ranked.after.times < first) | (ranked.after.times > last)
    apart = ranked.after.world[away, :, 3, :3] - ranked.before.world[away, :, 3, :3]
    assert ranked.millimetres(apart) <= 0.1
