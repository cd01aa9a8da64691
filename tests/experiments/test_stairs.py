"""2004, figure 7: level ground becomes irregular steps, and the pelvis goes over them evenly."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion.demos import gait, stairs
from usdmotion.demos.walker import RATE, SKELETON


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    shot = tmp_path_factory.mktemp("stairs") / "stairs.usda"
    stairs.build(shot)
    return shot


@pytest.fixture(scope="module")
def solved(stage, solve):
    return solve(stage, SKELETON)


def carried(solved):
    _, start, end, _ = stairs.CARRIES
    seconds = (solved.after.times - solved.after.times[0]) / RATE
    return (seconds >= start) & (seconds <= end)


def jerk(take):
    """Return the largest third difference of the root's place [m/s³]."""
    return np.linalg.norm(np.diff(take.point("Hips"), 3, axis=0), axis=1).max() * RATE**3


def test_the_feet_stand_on_their_steps(solved):
    walk = gait.walk()
    seconds = walk.motion.times
    points = {"heel": walk.heel_point, "toe": walk.toe_point}
    heights = {side: stairs.rise(walk, side, seconds) for side in ("Left", "Right")}
    for stance in walk.stances:
        there = (seconds >= stance.start - 1e-6) & (seconds <= stance.end + 1e-6)
        effector = stance.joint, points[stance.effector]
        moved = (solved.after.point(*effector) - solved.before.point(*effector))[there]
        height = heights[stance.side][there]
        assert np.ptp(height) == 0.0
        assert solved.millimetres(moved - height[:, None] * (0.0, 1.0, 0.0)) <= 0.1


def test_the_steps_are_irregular():
    falls = sorted({height for heights in stairs.STEPS.values() for height in heights})
    assert falls[-1] >= 0.2
    assert len(set(np.round(np.diff(falls), 3))) >= 4


def test_the_root_moves_as_evenly_as_in_the_input(solved):
    assert jerk(solved.after) <= 1.2 * jerk(solved.before)


def test_without_the_filter_it_does_not(stage, solve):
    opened = Usd.Stage.Open(str(stage))
    filtered = stage.parent / "unfiltered.usda"
    opened.GetPrimAtPath(f"{SKELETON}/Stairs").GetAttribute("usdmotion:smoothing").Set(0.0)
    opened.GetRootLayer().Export(str(filtered))
    rough = solve(filtered, SKELETON)
    assert jerk(rough.after) >= 3.0 * jerk(rough.before)


def test_the_elbow_is_in_its_place_against_the_torso(solved):
    apart = solved.after.seen_from("Spine2", "RightForeArm") - stairs.ELBOW
    assert solved.millimetres(apart[carried(solved)]) <= 0.1


def test_the_balance_is_kept(solved):
    body = gait.walk().body
    apart = solved.after.center_of_mass(body) - solved.before.center_of_mass(body)
    assert solved.millimetres(apart[:, [0, 2]]) <= 0.1


def test_no_knee_pops(solved):
    assert max(solved.pops("LeftLeg"), solved.pops("RightLeg")) <= 2.0
