"""2004, figures 5 and 6: the planted foot stands and the balance holds, whatever the kick wants."""

from pathlib import Path

import numpy as np
import pytest

from usdmotion.demos import karate
from usdmotion.demos.kick import kick
from usdmotion.demos.walker import SKELETON


@pytest.fixture
def ranked(demo, solve):
    return solve(demo("karate"), SKELETON)


@pytest.fixture
def kicked(tmp_path: Path, solve):
    """Return what kicks at a height."""

    def run(height):
        shot = tmp_path / "kick.usda"
        karate.build(shot, height=height)
        return solve(shot, SKELETON)

    return run


def planted_moved(solved):
    walk = kick()
    heel = solved.moved("LeftFoot", walk.heel_point)
    ball = solved.moved("LeftToeBase", walk.toe_point)
    return max(heel, ball, solved.moved("LeftFoot"))


def ankle_missed(solved, height):
    """Return how far the kicking ankle is from its goal on the plateau [mm on 1.7 m]."""
    _, start, end, _ = karate.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    assert there.sum() == end - start + 1
    x, z = karate.AHEAD
    return solved.millimetres((solved.after.point("RightFoot") - (x, height, z))[there])


def balance_moved(solved):
    body = kick().body
    apart = solved.after.center_of_mass(body) - solved.before.center_of_mass(body)
    return solved.millimetres(apart[:, [0, 2]])


def test_the_planted_foot_of_the_input_stands(ranked):
    walk = kick()
    for name, point in (("LeftFoot", walk.heel_point), ("LeftToeBase", walk.toe_point)):
        places = ranked.before.point(name, point)
        assert ranked.millimetres(places - places[0]) <= 0.01


def test_the_planted_foot_stands_although_the_ankle_misses(ranked):
    assert ankle_missed(ranked, karate.UNREACHABLE) >= 100.0
    assert planted_moved(ranked) <= 0.05


def test_the_balance_is_kept_although_the_ankle_misses(ranked):
    assert balance_moved(ranked) <= 0.05


def test_with_one_priority_the_planted_foot_moves(demo, solve):
    assert planted_moved(solve(demo("karate_weighted"), SKELETON)) >= 20.0


@pytest.mark.parametrize("height", karate.HEIGHTS)
def test_heights_within_reach_are_reached(kicked, height):
    solved = kicked(height)
    assert ankle_missed(solved, height) <= 0.05
    assert planted_moved(solved) <= 0.05
    assert balance_moved(solved) <= 0.05
    assert max(solved.pops("LeftLeg"), solved.pops("RightLeg")) <= 2.0


def test_before_and_after_the_kick_it_is_the_guard(ranked):
    first, _, _, last = karate.FRAMES
    away = (ranked.after.times < first) | (ranked.after.times > last + 8)
    apart = ranked.after.world[away, :, 3, :3] - ranked.before.world[away, :, 3, :3]
    assert np.abs(apart).max() <= 1e-4
